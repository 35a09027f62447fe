#include "allocations.h"

#include <atomic>
#include <cstddef>

namespace {
std::atomic<long> count{0};
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  ++count;
  return __libc_calloc(n, size);
}
void* realloc(void* pointer, std::size_t size) {
  ++count;
  return __libc_realloc(pointer, size);
}
}
bool sem_test::can_count_allocations() { return true; }
#else
bool sem_test::can_count_allocations() { return false; }
#endif

long sem_test::n_allocations() { return count; }

#pragma once
// Counts heap allocations of the whole test program by standing in front of malloc.

namespace sem_test {

/// False under the address sanitizer, which has its own malloc.
bool can_count_allocations();
/// Since the program started.
long n_allocations();

}  // namespace sem_test

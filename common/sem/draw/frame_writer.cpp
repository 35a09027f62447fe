#include "sem/draw/frame_writer.h"

#include <algorithm>
#include <utility>

namespace sem {

FrameWriter::FrameWriter(int capacity)
    : capacity_(std::max(1, capacity)), thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWriter::write(std::string path, Image image, double dots_per_inch) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || queue_.size() < capacity_; });
  rethrow();
  queue_.push_back({std::move(path), std::move(image), dots_per_inch});
  changed_.notify_all();
}

void FrameWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return queue_.empty() && !writing_; });
  rethrow();
}

void FrameWriter::rethrow() {
  if (error_) std::rethrow_exception(error_);
}

void FrameWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const Frame frame = std::move(queue_.front());
    queue_.pop_front();
    writing_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      write_png(frame.path, frame.image, frame.dots_per_inch);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    writing_ = false;
    if (error) {
      error_ = error;
      queue_.clear();
    }
    changed_.notify_all();
  }
}

}  // namespace sem

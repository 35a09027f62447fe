#pragma once
// Writes frames on a second thread, so that a frame is encoded while the next is computed.

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "sem/draw/image.h"

namespace sem {

/// A queue of at most `capacity` frames before one thread that runs write_png, in order. After an
/// error nothing more is written.
class FrameWriter {
 public:
  explicit FrameWriter(int capacity = 2);
  /// Writes what is queued; an error that finish() has not reported is lost.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Queues the frame; waits while the queue is full. Rethrows an error of an earlier frame.
  void write(std::string path, Image image, double dots_per_inch = 96);
  /// Waits until every queued frame is on disk and rethrows the first error. More may be written.
  void finish();

 private:
  struct Frame {
    std::string path;
    Image image;
    double dots_per_inch;
  };
  void run();
  void rethrow();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> queue_;
  bool writing_ = false, stopping_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: starts when all else exists
};

}  // namespace sem

#pragma once
// An OpenGL context without a window: the only file pair that knows of OSMesa. Where Mesa has
// dropped OSMesa, an EGL surfaceless context takes its place here.

#include <cstdint>
#include <memory>

namespace sem {

/// A compatibility context with a multisampled colour and 8-bit stencil buffer, or with a plain
/// colour buffer, which is several times faster.
class OffscreenContext {
 public:
  enum class Buffer { multisampled, plain };
  /// Throws InputError if the context cannot be created in this size.
  OffscreenContext(int width, int height, Buffer buffer = Buffer::multisampled);
  ~OffscreenContext();

  /// Sends the following GL calls of this thread to this context and its frame buffer.
  void make_current();

  /// Waits for the drawing; the pixels as RGBA bytes, first row at the top, valid until the next
  /// call to this object.
  const std::uint8_t* read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sem

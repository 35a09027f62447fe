#include "sem/draw/offscreen.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
// After osmesa.h, whose types it needs.
#include <GL/glext.h>

#include <string>
#include <vector>

#include "sem/base/error.h"

#if defined(__SANITIZE_ADDRESS__)
// OSMesa keeps a frame buffer per size until the end of the program: not our leak.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace sem {

struct OffscreenContext::Impl {
  int width, height;
  std::vector<std::uint8_t> pixels;  // what OSMesa renders to
  OSMesaContext context = nullptr;
  GLuint frame = 0, color = 0, stencil = 0;  // 0: the plain buffer, which is `pixels`

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        "", "off-screen canvas",
        what + " for " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
        "a size that OSMesa supports, and an installed libOSMesa with llvmpipe");
  }

  void bind() {
    if (!OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, width, height))
      fail("OSMesaMakeCurrent failed");
    OSMesaPixelStore(OSMESA_Y_UP, 0);
  }

  static GLuint attach(GLenum attachment, GLenum format, int width, int height) {
    GLuint buffer = 0;
    glGenRenderbuffers(1, &buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, 4, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
    return buffer;
  }
};

OffscreenContext::OffscreenContext(int width, int height, Buffer buffer) : impl_(new Impl) {
  impl_->width = width;
  impl_->height = height;
  impl_->pixels.resize(4 * std::size_t(width) * height);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_COMPAT_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            1,
                            0};
  impl_->context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!impl_->context) impl_->fail("no context");
  try {
    impl_->bind();
    if (buffer == Buffer::plain) return;
    glGenFramebuffers(1, &impl_->frame);
    glBindFramebuffer(GL_FRAMEBUFFER, impl_->frame);
    impl_->color = Impl::attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, width, height);
    impl_->stencil = Impl::attach(GL_STENCIL_ATTACHMENT, GL_STENCIL_INDEX8, width, height);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      impl_->fail("no multisampled frame buffer");
  } catch (...) {
    OSMesaDestroyContext(impl_->context);
    throw;
  }
}

OffscreenContext::~OffscreenContext() { OSMesaDestroyContext(impl_->context); }

void OffscreenContext::make_current() {
  if (OSMesaGetCurrentContext() != impl_->context) impl_->bind();
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->frame);
}

const std::uint8_t* OffscreenContext::read() {
  make_current();
  const int w = impl_->width, h = impl_->height;
  if (impl_->frame != 0) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glFinish();
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->frame);
  return impl_->pixels.data();
}

}  // namespace sem

#include "src3d/render/gl.h"

#include <numeric>
#include <stdexcept>

namespace sem::render {
namespace {

GLuint compile(const char* name, GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  char log[4096] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  glDeleteShader(shader);
  throw std::runtime_error(std::string("GLSL program '") + name + "', " +
                           (kind == GL_VERTEX_SHADER ? "vertex" : "fragment") + " shader:\n" + log);
}

}  // namespace

void check_gl(const char* where) {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    while (glGetError() != GL_NO_ERROR) {
    }
    throw std::runtime_error("OpenGL error " + std::to_string(error) + " after " + where);
  }
}

Program::Program(const char* name, const std::string& vertex, const std::string& fragment) {
  const GLuint shaders[] = {compile(name, GL_VERTEX_SHADER, vertex),
                            compile(name, GL_FRAGMENT_SHADER, fragment)};
  id_ = glCreateProgram();
  for (const GLuint shader : shaders) {
    glAttachShader(id_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(id_);
  GLint ok = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (ok) return;
  char log[4096] = "";
  glGetProgramInfoLog(id_, sizeof log, nullptr, log);
  glDeleteProgram(id_);
  throw std::runtime_error(std::string("GLSL program '") + name + "', linking:\n" + log);
}

Target::Target(int w, int h, const std::vector<GLenum>& formats, Depth depth)
    : width(w), height(h) {
  glGenFramebuffers(1, &frame_);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  std::vector<GLenum> buffers;
  for (const GLenum format : formats) {
    color_.push_back(make_texture(format, false));
    buffers.push_back(GLenum(GL_COLOR_ATTACHMENT0 + buffers.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, color_.back(), 0);
  }
  if (depth != Depth::none) {
    depth_ = make_texture(GL_DEPTH_COMPONENT32F, depth == Depth::compared);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  }
  if (buffers.empty())
    glDrawBuffer(GL_NONE);
  else
    glDrawBuffers(GLsizei(buffers.size()), buffers.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL frame buffer of " + std::to_string(w) + " x " +
                             std::to_string(h) + " pixels is not complete");
}

Target::~Target() {
  glDeleteFramebuffers(1, &frame_);
  glDeleteTextures(GLsizei(color_.size()), color_.data());
  if (depth_) glDeleteTextures(1, &depth_);
}

GLuint Target::make_texture(GLenum format, bool compared) const {
  GLuint id = 0;
  glGenTextures(1, &id);
  glBindTexture(GL_TEXTURE_2D, id);
  const GLint filter = compared ? GL_LINEAR : GL_NEAREST;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  if (compared) glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  return id;
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, width, height);
}

void Target::bind(GLuint texture, int unit) {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

VertexArray::VertexArray(const std::vector<float>& vertices, const std::vector<int>& layout,
                         const std::vector<unsigned>& indices, int divisor) {
  glGenVertexArrays(1, &id_);
  glBindVertexArray(id_);
  glGenBuffers(1, &vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(float)), vertices.data(),
               GL_STATIC_DRAW);
  if (!indices.empty()) {
    glGenBuffers(1, &indices_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(unsigned)),
                 indices.data(), GL_STATIC_DRAW);
  }
  const int stride = std::accumulate(layout.begin(), layout.end(), 0) * int(sizeof(float));
  std::size_t offset = 0;
  for (GLuint a = 0; a < layout.size(); ++a) {
    glEnableVertexAttribArray(a);
    glVertexAttribPointer(a, layout[a], GL_FLOAT, GL_FALSE, stride,
                          reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(a, GLuint(divisor));
    offset += std::size_t(layout[a]) * sizeof(float);
  }
}

VertexArray::~VertexArray() {
  glDeleteVertexArrays(1, &id_);
  glDeleteBuffers(1, &vertices_);
  if (indices_) glDeleteBuffers(1, &indices_);
}

}  // namespace sem::render

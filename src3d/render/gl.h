#pragma once
// OpenGL objects that free themselves. All need the renderer's context to be current.

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
// After gl.h, whose types it needs.
#include <GL/glext.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sem::render {

/// Throws std::runtime_error naming the place if OpenGL has recorded an error.
void check_gl(const char* where);

/// A vertex and a fragment shader.
class Program {
 public:
  /// Throws std::runtime_error with the log if a source is rejected.
  Program(const char* name, const std::string& vertex, const std::string& fragment);
  ~Program() { glDeleteProgram(id_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(id_); }
  // Of the program in use.
  void set(const char* name, int value) const { glUniform1i(at(name), value); }
  void set(const char* name, float value) const { glUniform1f(at(name), value); }
  void set(const char* name, const Eigen::Vector2f& v) const {
    glUniform2fv(at(name), 1, v.data());
  }
  void set(const char* name, const Eigen::Vector3f& v) const {
    glUniform3fv(at(name), 1, v.data());
  }
  void set(const char* name, const Eigen::Vector4f& v) const {
    glUniform4fv(at(name), 1, v.data());
  }
  void set(const char* name, const std::vector<Eigen::Vector4f>& v) const {
    glUniform4fv(at(name), GLsizei(v.size()), v[0].data());
  }
  void set(const char* name, const std::vector<Eigen::Matrix4f>& m) const {
    glUniformMatrix4fv(at(name), GLsizei(m.size()), GL_FALSE, m[0].data());
  }
  void set(const char* name, const Eigen::Matrix4f& m) const {
    glUniformMatrix4fv(at(name), 1, GL_FALSE, m.data());
  }

 private:
  GLint at(const char* name) const { return glGetUniformLocation(id_, name); }
  GLuint id_;
};

/// Colour textures and a depth texture of one size to draw into.
class Target {
 public:
  /// `formats` of the colour textures, e.g. GL_RGBA8; depth as 32-bit floats, if asked for.
  /// Compared depths are looked up interpolated, with a comparison (shadow maps).
  enum class Depth { none, plain, compared };
  Target(int width, int height, const std::vector<GLenum>& formats, Depth depth);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Draws into it, over all of it.
  void bind() const;
  void bind_color(int index, int unit) const { bind(color_[index], unit); }
  void bind_depth(int unit) const { bind(depth_, unit); }

  const int width, height;

 private:
  static void bind(GLuint texture, int unit);
  GLuint make_texture(GLenum format, bool compared) const;
  GLuint frame_ = 0, depth_ = 0;
  std::vector<GLuint> color_;
};

/// Vertices of `floats` each: attribute a has layout[a] of them.
class VertexArray {
 public:
  VertexArray(const std::vector<float>& vertices, const std::vector<int>& layout,
              const std::vector<unsigned>& indices = {}, int divisor = 0);
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  void bind() const { glBindVertexArray(id_); }

 private:
  GLuint id_ = 0, vertices_ = 0, indices_ = 0;
};

}  // namespace sem::render

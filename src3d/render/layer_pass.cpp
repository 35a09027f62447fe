// Translucent surfaces, layer by layer.
#include <algorithm>

#include "src3d/render/passes.h"

namespace sem::render {
namespace {

constexpr int most_layers = 16;  // of translucent surfaces behind each other

}  // namespace

// Depth peeling: layer by layer from the front, each under those before it.
void Picture::draw_translucent(const Target& picture) const {
  const bool any = std::any_of(triangles_.batches.begin(), triangles_.batches.end(),
                               [](const Batch& b) { return b.opacity < 1; });
  if (!any) return;
  limit_to_translucent();
  const Target sum(width_, height_, {GL_RGBA16F}, Target::Depth::none);
  const Target layers[2] = {{width_, height_, {GL_RGBA8}, Target::Depth::plain},
                            {width_, height_, {GL_RGBA8}, Target::Depth::plain}};
  glClearColor(0, 0, 0, 0);
  sum.bind();
  glClear(GL_COLOR_BUFFER_BIT);
  layers[1].bind();
  glClearDepth(0);
  glClear(GL_DEPTH_BUFFER_BIT);
  glClearDepth(1);
  GLuint query = 0;
  glGenQueries(1, &query);
  for (int k = 0; k < most_layers; ++k) {
    const Target &now = layers[k % 2], &last = layers[(k + 1) % 2];
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query);
    draw_layer(now, last, picture);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    GLuint any_seen = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &any_seen);
    if (!any_seen) break;
    sum.bind();
    blend(now, GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  }
  glDeleteQueries(1, &query);
  picture.bind();
  blend(sum, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_SCISSOR_TEST);
}

// No pixel outside of the translucent meshes' projection is touched.
void Picture::limit_to_translucent() const {
  Box<2> box;
  for (const auto& mesh : scene_.meshes)
    if (mesh.color.a < 1)
      for (const auto& X : mesh.position) box.include(camera_.project(X));
  const double n = options_.supersample;
  const Vec<2> lower = (n * box.lower).cwiseMax(0).array().floor(),
               upper = (n * box.upper).cwiseMin(Vec<2>(width_, height_)).array().ceil();
  glEnable(GL_SCISSOR_TEST);
  glScissor(int(lower[0]), height_ - int(upper[1]), std::max(int(upper[0] - lower[0]), 0),
            std::max(int(upper[1] - lower[1]), 0));
}

void Picture::draw_layer(const Target& now, const Target& last, const Target& picture) const {
  now.bind();
  glEnable(GL_DEPTH_TEST);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  set_light(*gl_.layer);
  last.bind_depth(0);
  picture.bind_depth(1);
  gl_.layer->set("last_depth", 0);
  gl_.layer->set("opaque_depth", 1);
  draw_batches(*gl_.layer, true);
}

void Picture::blend(const Target& from, GLenum source, GLenum destination) const {
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(source, destination);
  gl_.copy->use();
  from.bind_color(0, 0);
  gl_.copy->set("source", 0);
  draw_screen();
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace sem::render

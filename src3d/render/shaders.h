#pragma once
// The GLSL programs of the renderer. Positions are relative to the scene's centre, in units of its
// radius.

namespace sem::render::shaders {

// Surfaces, in all passes: corners of triangles.
inline constexpr const char* surface_vertex = R"(#version 330
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in float lit;
uniform mat4 to_clip;
uniform vec4 kept;  // shown where dot(kept, (X, 1)) >= 0
out vec3 X, N;
out vec4 albedo;  // linear if lit
flat out float is_lit;
invariant gl_Position;
vec3 linear_of(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}
void main() {
  X = position;
  N = normal;
  albedo = vec4(lit > 0 ? linear_of(color.rgb) : color.rgb, color.a);
  is_lit = lit;
  gl_Position = to_clip * vec4(position, 1);
  gl_ClipDistance[0] = dot(kept, vec4(position, 1));
}
)";

inline constexpr const char* depth_vertex = R"(#version 330
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
uniform vec4 kept;
void main() {
  gl_Position = to_clip * vec4(position, 1);
  gl_ClipDistance[0] = dot(kept, vec4(position, 1));
}
)";
inline constexpr const char* depth_fragment = R"(#version 330
void main() {}
)";

// Where a pixel is and which way it faces; the side that is seen counts.
inline constexpr const char* geometry_fragment = R"(#version 330
in vec3 X, N;
uniform float is_ground;
layout(location = 0) out vec4 at;
layout(location = 1) out vec4 facing;
void main() {
  at = vec4(X, 1);
  facing = vec4(gl_FrontFacing ? normalize(N) : -normalize(N), is_ground);
}
)";

// A rectangle over everything, made of gl_VertexID.
inline constexpr const char* screen_vertex = R"(#version 330
void main() {
  gl_Position = vec4(gl_VertexID % 2 * 2 - 1, gl_VertexID / 2 * 2 - 1, 0, 1);
}
)";

// Adds what a few directions of light contribute: key light seen (r), sky seen (g).
inline constexpr const char* visibility_fragment = R"(#version 330
const int n_most = 16, n_side = 4;
uniform sampler2D position, normal;
uniform sampler2DShadow maps;  // n_side x n_side tiles
uniform int n_lights;
uniform mat4 to_light[n_most];  // to [0, 1]^3 of the light's map
uniform vec4 toward[n_most];    // unit vector to the light; weight in the sky, 0: key light
uniform float key_weight, offset, tile_border;
layout(location = 0) out vec4 seen;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 at = texelFetch(position, pixel, 0);
  if (at.w == 0) discard;
  vec4 facing = texelFetch(normal, pixel, 0);
  vec3 n = facing.xyz;
  // Ground: 4 x 4 pixels look from different places; their mean (pack) has no edges of single lights.
  vec3 across = normalize(cross(n, vec3(0.83, 0.21, 0.52)));
  int cell = (pixel.x & 3) + 4 * (pixel.y & 3);
  float angle = 2.399963 * cell, reach = facing.w * sqrt((cell + 0.5) / 16);
  vec3 aside = reach * (cos(angle) * across + sin(angle) * cross(n, across));
  float wide = 0.05 + 0.3 * max(length(at.xyz) - 1, 0.0);  // of the sky, whose directions are few
  vec2 sum = vec2(0);
  for (int i = 0; i < n_lights; ++i) {
    float cosine = dot(n, toward[i].xyz);
    if (cosine <= 0) continue;
    // Off the surface, farther where the light grazes it: a surface casts no shadow on itself.
    vec3 from = at.xyz + offset * (1 + 2 * sqrt(1 - cosine * cosine)) * n +
                (toward[i].w == 0 ? 0.01 : wide) * aside;
    vec3 q = (to_light[i] * vec4(from, 1)).xyz;
    float visible = 1;
    if (all(greaterThan(q.xy, vec2(tile_border))) && all(lessThan(q.xy, vec2(1 - tile_border))))
      visible = texture(maps, vec3((q.xy + vec2(i % n_side, i / n_side)) / n_side, min(q.z, 1.0)));
    if (toward[i].w == 0) sum.x += visible * key_weight;
    else sum.y += visible * toward[i].w * cosine;
  }
  seen = vec4(sum, 0, 0);
}
)";

// Visibility with what tells neighbouring pixels of other surfaces apart: depth, a scalar of the
// normal.
inline constexpr const char* pack_fragment = R"(#version 330
uniform sampler2D position, normal, seen;
uniform vec4 depth_row;
layout(location = 0) out vec4 packed_pixel;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 at = texelFetch(position, pixel, 0), facing = texelFetch(normal, pixel, 0);
  float side = dot(facing.xyz, vec3(0.61, 0.33, 0.72));
  float depth = at.w == 0 ? -1 : dot(depth_row, vec4(at.xyz, 1));
  vec2 mean = texelFetch(seen, pixel, 0).xy;
  if (facing.w > 0) {
    vec3 sum = vec3(0);
    ivec2 last = textureSize(seen, 0) - 1;
    for (int k = 0; k < 16; ++k) {
      ivec2 other = clamp(pixel + ivec2(k & 3, k >> 2) - 1, ivec2(0), last);
      if (texelFetch(normal, other, 0).w > 0) sum += vec3(texelFetch(seen, other, 0).xy, 1);
    }
    mean = sum.xy / sum.z;
  }
  packed_pixel = vec4(mean, depth, side);
}
)";

// sRGB colour of a lit point of some linear albedo; programs below that call it begin with this.
inline constexpr const char* light = R"(
uniform vec3 to_key, eye, back;
uniform float is_parallel;
uniform float key, ambient, gloss;
vec3 srgb_of(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
vec3 to_eye(vec3 X) { return is_parallel > 0 ? back : normalize(eye - X); }
vec3 shaded(vec3 linear, vec3 X, vec3 n, vec2 seen) {
  vec3 h = normalize(to_key + to_eye(X));
  float light = ambient * seen.y + key * seen.x * max(dot(n, to_key), 0.0);
  return srgb_of(linear * light + gloss * seen.x * pow(max(dot(n, h), 0.0), 32.0));
}
// Light of the whole sky on a free surface, 1 where it faces up: the sky's light is linear in the
// height, so its integral with the cosine is, too.
uniform vec3 up;
uniform float from_below;
float sky(vec3 n) {
  float mean = (1 + from_below) / 2, slope = (1 - from_below) / 3;
  return (mean + slope * dot(n, up)) / (mean + slope);
}
)";

// Follows `light` in surfaces that receive shadows: the packed visibility of the four pixels
// around, without those of other surfaces.
inline constexpr const char* visibility_lookup = R"(
uniform sampler2D visibility;
uniform vec4 depth_row;
uniform vec2 to_visibility;
vec2 seen_at(vec3 X, vec3 n) {
  vec2 at = gl_FragCoord.xy * to_visibility - 0.5;
  ivec2 base = ivec2(floor(at));
  vec2 share = at - vec2(base);
  float depth = dot(depth_row, vec4(X, 1)), side = dot(n, vec3(0.61, 0.33, 0.72));
  vec2 slope = vec2(dFdx(depth), dFdy(depth)) / to_visibility;
  ivec2 last = textureSize(visibility, 0) - 1;
  vec3 sum = vec3(0);
  for (int k = 0; k < 4; ++k) {
    ivec2 step = ivec2(k & 1, k >> 1);
    vec4 other = texelFetch(visibility, clamp(base + step, ivec2(0), last), 0);
    if (other.z < 0) continue;
    float expected = depth + dot(slope, vec2(step) - share);
    float weight = (step.x == 1 ? share.x : 1 - share.x) * (step.y == 1 ? share.y : 1 - share.y);
    float unlike = 400 * abs(other.z - expected) + 20 * abs(other.w - side);
    weight = (weight + 0.02) / (1 + unlike * unlike * unlike);
    sum += weight * vec3(other.xy, 1);
  }
  return sum.z > 0 ? sum.xy / sum.z : vec2(1, 1);
}
)";

inline constexpr const char* surface_fragment = R"(
in vec3 X, N;
in vec4 albedo;
flat in float is_lit;
layout(location = 0) out vec4 color;
void main() {
  vec3 n = gl_FrontFacing ? normalize(N) : -normalize(N);
  color = vec4(is_lit > 0 ? shaded(albedo.rgb, X, n, seen_at(X, n)) : albedo.rgb, 1);
}
)";

// White where nothing is in the way of the light, and far out.
inline constexpr const char* ground_fragment = R"(
in vec3 X, N;
in vec4 albedo;
flat in float is_lit;
uniform vec3 ground_center;
uniform vec2 picture_size;
layout(location = 0) out vec4 color;
void main() {
  vec2 seen = seen_at(X, up);
  float key_share = key * max(dot(up, to_key), 0.0);
  float light = (ambient * min(seen.y, 1.0) + key_share * seen.x) / (ambient + key_share);
  vec2 border = min(gl_FragCoord.xy, picture_size - gl_FragCoord.xy) / (0.12 * min(picture_size.x, picture_size.y));
  float far = 1.0 - (1.0 - smoothstep(1.0, 2.1, distance(X, ground_center))) *
                        smoothstep(0.0, 1.0, min(border.x, border.y));
  color = vec4(srgb_of(vec3(mix(light, 1.0, far))), 1);
}
)";

// A layer of what is translucent: the nearest behind the last one and in front of all that is
// opaque.
inline constexpr const char* layer_fragment = R"(
in vec3 X, N;
in vec4 albedo;
flat in float is_lit;
uniform sampler2D last_depth, opaque_depth;
layout(location = 0) out vec4 color;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (gl_FragCoord.z <= texelFetch(last_depth, pixel, 0).x + 1e-6 ||
      gl_FragCoord.z >= texelFetch(opaque_depth, pixel, 0).x) discard;
  vec3 n = gl_FrontFacing ? normalize(N) : -normalize(N);
  float path = 1 / max(abs(dot(n, to_eye(X))), 0.08);  // through a shell of unit thickness
  float opacity = 1 - pow(1 - albedo.a, path);
  vec3 c = is_lit > 0 ? shaded(albedo.rgb, X, n, vec2(1, sky(n))) : albedo.rgb;
  color = vec4(c * opacity, opacity);
}
)";

// Copies a texture, to be blended.
inline constexpr const char* copy_fragment = R"(#version 330
uniform sampler2D source;
layout(location = 0) out vec4 color;
void main() { color = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

// Spheres: a square about each, its pixels moved onto the sphere.
inline constexpr const char* sphere_vertex = R"(#version 330
layout(location = 0) in vec4 center_radius;
layout(location = 1) in vec4 color;
uniform mat4 to_clip;
uniform vec3 eye, back, camera_up;
uniform float is_parallel;
out vec2 corner;
flat out vec3 center, across, upward, near;
flat out float radius;
flat out vec3 albedo;
vec3 linear_of(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}
void main() {
  corner = vec2(gl_VertexID % 2 * 2 - 1, gl_VertexID / 2 * 2 - 1);
  center = center_radius.xyz;
  radius = center_radius.w;
  albedo = linear_of(color.rgb);
  near = is_parallel > 0 ? back : normalize(eye - center);
  across = normalize(cross(camera_up, near));
  upward = cross(near, across);
  gl_Position = to_clip * vec4(center + radius * (corner.x * across + corner.y * upward), 1);
}
)";
inline constexpr const char* sphere_fragment = R"(
in vec2 corner;
flat in vec3 center, across, upward, near;
flat in float radius;
flat in vec3 albedo;
uniform mat4 to_clip;
layout(location = 0) out vec4 color;
void main() {
  float square = dot(corner, corner);
  if (square > 1) discard;
  vec3 n = corner.x * across + corner.y * upward + sqrt(1 - square) * near;
  vec3 X = center + radius * n;
  vec4 clip = to_clip * vec4(X, 1);
  gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w;
  color = vec4(shaded(albedo, X, n, vec2(1, sky(n))), 1);
}
)";

// Lines, widened on the processor.
inline constexpr const char* line_vertex = R"(#version 330
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 color;
flat out vec4 tint;
void main() {
  tint = color;
  gl_Position = clip;
}
)";
inline constexpr const char* line_fragment = R"(#version 330
flat in vec4 tint;
uniform float opacity;
layout(location = 0) out vec4 color;
void main() { color = vec4(tint.rgb, tint.a * opacity); }
)";

}  // namespace sem::render::shaders

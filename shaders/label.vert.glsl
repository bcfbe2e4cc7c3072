// Glyphs of labels, laid out in pixels by the renderer; the anchor decides whether a label is hidden.
#include "frame.glsl"

layout(location = 0) in vec2 a_pixel;   // px from the top left corner
layout(location = 1) in vec2 a_uv;
layout(location = 2) in vec4 a_color;   // bytes b, g, r, a
layout(location = 3) in vec3 a_anchor;  // x, y in 0 .. 1 of the picture, depth 0 .. 1; depth below 0: never hidden

uniform sampler2D t_depth;
uniform vec2 u_pixels;

out vec2 v_uv;
flat out vec4 v_color;

void main() {
  float seen = a_anchor.z < 0.0 ? 1.0 : textureLod(t_depth, a_anchor.xy, 0.0).r;
  float strength = a_anchor.z <= seen ? 1.0 : 0.35;
  v_uv = a_uv;
  v_color = vec4(a_color.bgr, a_color.a * strength);
  vec2 ndc = a_pixel / u_pixels * 2.0 - 1.0;
  gl_Position = vec4(ndc.x, -ndc.y, 0.0, 1.0);
}

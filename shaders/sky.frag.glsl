// The sky behind everything. A fixed pattern of less than a step hides the steps of 8-bit colour.
#include "frame.glsl"

in vec2 v_uv;
out vec4 o_color;

void main() {
  vec2 ndc = 2.0 * v_uv - 1.0;
  vec3 direction = normalize(ray_forward.xyz + ndc.x * ray_right.xyz + ndc.y * ray_up.xyz);
  vec3 radiance = direction.y > 0.0 ? skyAbove(direction.y) : skyBelow(direction.y);
  float grain = fract(dot(floor(gl_FragCoord.xy), vec2(0.7548777, 0.5698403))) - 0.5;
  o_color = vec4(encode(tone(radiance)) + grain / 255.0, 1.0);
}

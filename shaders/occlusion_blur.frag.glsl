// Smooths the estimate of occlusion over a 4 x 4 neighbourhood of equal depth, and writes the factor for colours that are
// stored as square roots.
#include "frame.glsl"

uniform sampler2D t_open;
uniform sampler2D t_depth;

in vec2 v_uv;
out vec4 o_factor;

float distanceAt(vec2 uv) {
  float depth = textureLod(t_depth, uv, 0.0).r;
  return 1.0 / max(1.0 - depth, 1e-6);
}

void main() {
  float center = distanceAt(v_uv), sum = 0.0, weights = 1e-4;
  for (int y = -2; y < 2; ++y)
    for (int x = -2; x < 2; ++x) {
      vec2 uv = v_uv + (vec2(x, y) + 0.5) * 2.0 * viewport.zw;
      float w = max(1.0 - abs(distanceAt(uv) / center - 1.0) * 40.0, 0.0);
      sum += w * textureLod(t_open, uv, 0.0).r;
      weights += w;
    }
  float open = weights > 0.01 ? sum / weights : 1.0;
  o_factor = vec4(vec3(sqrt(open)), 1.0);
}

// How open the sky is above each point, estimated from depth alone at half the resolution: samples on a spiral in the
// plane of the screen, each a small solid angle of horizon.
// After M. McGuire, B. Mara, D. Luebke, The Alchemy Screen-Space Ambient Obscurance Algorithm, HPG 2011, eq. 10.
#include "frame.glsl"

uniform sampler2D t_depth;
uniform mat4 u_world_from_clip;
uniform float u_radius;  // m

in vec2 v_uv;
out vec4 o_open;

vec3 worldAt(vec2 uv) {
  float depth = textureLod(t_depth, uv, 0.0).r;
  vec4 p = u_world_from_clip * vec4(2.0 * vec3(uv, depth) - 1.0, 1.0);
  return p.xyz / p.w;
}

void main() {
  if (textureLod(t_depth, v_uv, 0.0).r >= 1.0) {
    o_open = vec4(1.0);
    return;
  }
  vec3 p = worldAt(v_uv);
  // Of the two neighbours on each side the nearer one belongs to the same surface.
  vec2 texel = viewport.zw * 2.0;
  vec3 right = worldAt(v_uv + vec2(texel.x, 0.0)) - p, left = p - worldAt(v_uv - vec2(texel.x, 0.0));
  vec3 up = worldAt(v_uv + vec2(0.0, texel.y)) - p, down = p - worldAt(v_uv - vec2(0.0, texel.y));
  vec3 dx = dot(right, right) < dot(left, left) ? right : left, dy = dot(up, up) < dot(down, down) ? up : down;
  vec3 normal = normalize(cross(dx, dy));

  float away = eye.w > 0.5 ? dot(p - eye.xyz, ray_forward.xyz) : 1.0;
  vec2 reach = u_radius / away / vec2(length(ray_right.xyz), length(ray_up.xyz)) * 0.5;
  const int kSamples = 16;
  float turn = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) * 6.2831853;
  float sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    float part = (float(i) + 0.5) / float(kSamples), angle = part * 43.982297 + turn;
    vec3 v = worldAt(v_uv + reach * part * vec2(cos(angle), sin(angle))) - p;
    float vv = dot(v, v), f = max(u_radius * u_radius - vv, 0.0) / (u_radius * u_radius);
    sum += f * f * f * max(dot(v, normal) - 0.004 * away, 0.0) / (vv + 0.0004 * u_radius * u_radius) * u_radius;
  }
  o_open = vec4(max(0.0, 1.0 - 0.85 * sum / float(kSamples)));
}

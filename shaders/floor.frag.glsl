// Large fixed floors: a metre grid, and a soft end in the background far from what is looked at.
#include "frame.glsl"
#include "shading.glsl"

in vec3 v_position;
in vec3 v_normal;
in vec3 v_edge;
in float v_haze;
flat in vec4 v_color;
flat in float v_sheen;
flat in uint v_finish;
out vec4 o_color;

// Lines of `width` pixels at every integer; each direction fades where its lines come closer than a few pixels.
float gridLines(vec2 p, vec2 slope, float width) {
  vec2 away = abs(fract(p - 0.5) - 0.5) / slope;
  vec2 line = clamp(width + 0.5 - away, 0.0, 1.0) * clamp(1.3 - 3.7 * slope, 0.0, 1.0);
  return max(line.x, line.y);
}

void main() {
  vec3 normal = normalize(v_normal);
  vec2 slope = max(fwidth(v_position.xz) * fog.z, 1e-5);
  float fine = gridLines(v_position.xz, slope, 0.55);
  float coarse = gridLines(v_position.xz * 0.1, slope * 0.1, 0.9);
  vec3 albedo = v_color.rgb * (1.0 - max(0.12 * fine, 0.24 * coarse) * step(0.9, normal.y));

  float direct = max(dot(normal, sun.xyz), 0.0) * sunlight(v_position, normal);
  vec3 color = diffuse(normal, albedo, direct);

  float away = distance(v_position, floor_fade.xyz) * floor_fade.w - 1.0;
  float y = (v_position.y - eye.y) / distance(v_position, eye.xyz);
  vec3 behind = eye.w > 0.5 ? skyBelow(y) : skyBelow(ray_forward.y);
  float fade = clamp(away * 0.625, 0.0, 1.0);
  color = mix(color, behind, fade * fade * (3.0 - 2.0 * fade));
  o_color = vec4(encode(tone(color)), v_color.a);
}

// Lit triangles with their feature edges drawn in, and a metre grid on large fixed floors.
#include "frame.glsl"
#include "shading.glsl"

uniform float u_wire;  // strength of the plain edges, 0 .. 1

in vec3 v_position;
in vec3 v_normal;
in vec3 v_edge;
flat in vec4 v_color;
flat in uint v_finish;
flat in float v_grid;
out vec4 o_color;

// How much of an edge covers this sample: half a pixel wide on either face, fading where faces are a few pixels small.
float edges(float wire) {
  vec3 plain = step(1.5, v_edge);
  vec3 height = v_edge - 2.0 * plain;
  vec3 slope = max(fwidth(height), 1e-6);
  vec3 line = 1.0 - smoothstep(0.35, 1.15, height / slope / fog.z);
  vec3 room = clamp(1.0 / (slope * fog.z * 14.0) - 0.25, 0.0, 1.0);
  vec3 shown = line * room * mix(vec3(1.0), vec3(wire), plain);
  return max(shown.x, max(shown.y, shown.z));
}

float gridLines(vec2 p, float width) {
  vec2 slope = max(fwidth(p), 1e-5);
  vec2 away = abs(fract(p - 0.5) - 0.5) / slope;
  vec2 line = 1.0 - smoothstep(width - 0.5, width + 0.5, away / fog.z);
  line *= 1.0 - smoothstep(0.08, 0.35, slope / fog.z);
  return max(line.x, line.y);
}

void main() {
  vec3 normal = normalize(v_normal);
  vec3 albedo = v_color.rgb;
  if (v_grid > 0.5 && normal.y > 0.9) {
    float fine = gridLines(v_position.xz, 0.55), coarse = gridLines(v_position.xz * 0.1, 0.9);
    albedo *= 1.0 - max(0.13 * fine, 0.26 * coarse);
  }
  vec3 color = shade(v_position, normal, albedo, v_finish);
  color *= 1.0 - 0.5 * edges(u_wire);
  o_color = vec4(encode(tone(withHaze(color, v_position))), v_color.a);
}

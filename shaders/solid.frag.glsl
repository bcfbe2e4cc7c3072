// Lit triangles with their feature edges drawn in; with WIRE all edges.
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

// How much of an edge covers this sample: half a pixel wide on either face, fading where faces are a few pixels small.
// Edges that are not features start at 2 (kPlainEdge) and are never near.
float edges() {
  vec3 slope = max(fwidth(v_edge), 1e-6);
#ifdef WIRE
  vec3 away = (v_edge - 2.0 * step(1.5, v_edge)) / slope;
#else
  vec3 away = v_edge / slope;
#endif
  float line = clamp(1.45 - 1.25 / fog.z * min(away.x, min(away.y, away.z)), 0.0, 1.0);
  return line * clamp(1.0 / (max(slope.x, max(slope.y, slope.z)) * fog.z * 14.0) - 0.25, 0.0, 1.0);
}

void main() {
  vec3 color = shade(v_position, normalize(v_normal), v_color.rgb, v_sheen, v_finish);
  color = mix(color * (1.0 - 0.5 * edges()), kSkyHorizon, v_haze);
  o_color = vec4(encode(tone(color)), v_color.a);
}

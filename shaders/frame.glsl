// What all passes know about a frame. Mirrors viewer/render/frame_block.h.
layout(std140) uniform Frame {
  mat4 clip_from_world;
  mat4 sun_from_world;  // to shadow-map coordinates, 0 .. 1
  vec4 eye;             // xyz: m; w: 1 perspective, 0 orthographic
  vec4 ray_right;       // from the middle of the picture to its right edge, at unit distance
  vec4 ray_up;
  vec4 ray_forward;     // unit
  vec4 sun;             // xyz: unit, towards the sun; w: 1 with shadows
  vec4 viewport;        // width, height in samples, and their inverses
  vec4 shadow;          // x: texel in shadow-map coordinates; y: texel in metres; z: radius of the filter in texels
  vec4 fog;             // x: distance where haze starts (m); y: 1 / its range; z: samples along a pixel's side
  vec4 floor_fade;      // xyz: middle of the part of large floors that is shown (m); w: 1 / its radius (1/m)
};

const vec3 kSkyZenith = vec3(0.170, 0.330, 0.610);
const vec3 kSkyMiddle = vec3(0.340, 0.545, 0.810);
const vec3 kSkyHorizon = vec3(0.800, 0.860, 0.905);
const vec3 kHaze = vec3(0.700, 0.735, 0.755);

// Radiance of the sky in a direction (unit) of height y, linear: above and below the horizon.
vec3 skyAbove(float y) {
  return mix(mix(kSkyHorizon, kSkyMiddle, smoothstep(0.0, 0.24, y)), kSkyZenith, smoothstep(0.2, 0.95, y));
}
vec3 skyBelow(float y) { return mix(kSkyHorizon, kHaze, clamp(-5.0 * y, 0.0, 1.0)); }

// Colours are stored as square roots, which are cheap to filter and fine enough in the dark.
vec3 encode(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }

// Stretches shadows and rolls off highlights, leaving the middle close to what it was.
vec3 tone(vec3 c) { return c * (1.0 + 0.16 * c) / (1.0 + 0.42 * c) * 1.10; }

vec3 linearFromSrgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

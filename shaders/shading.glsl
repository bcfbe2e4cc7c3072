// Light on a surface: sun with soft shadow, sky from above, bounce from below, and with SHINY a glossy or metallic finish.
// Needs frame.glsl. Software rasterizers run both sides of every branch, so what differs a lot is a program of its own.
uniform sampler2DShadow t_shadow;

const vec3 kSunLight = vec3(1.42, 1.26, 1.01);
const vec3 kSkyLight = vec3(0.35, 0.41, 0.50);
const vec3 kBounceLight = vec3(0.20, 0.165, 0.135);

#ifdef NO_SHADOW
float sunlight(vec3 position, vec3 normal) { return 1.0; }
#else
// Part of the sun that reaches a point: bilinear comparisons on a rotated grid, which is one smooth ramp.
float sunlight(vec3 position, vec3 normal) {
  // Off the surface by as much as the filter reaches, against self-shadowing.
  vec3 p = (sun_from_world * vec4(position + normal * shadow.y * shadow.z, 1.0)).xyz;
  float r = shadow.x;
  float lit = texture(t_shadow, p + vec3(-0.5 * r, 1.5 * r, 0.0)) + texture(t_shadow, p + vec3(1.5 * r, 0.5 * r, 0.0)) +
              texture(t_shadow, p + vec3(0.5 * r, -1.5 * r, 0.0)) + texture(t_shadow, p + vec3(-1.5 * r, -0.5 * r, 0.0));
#ifdef WIDE_SHADOW
  lit = 0.5 * lit +
        0.5 * (texture(t_shadow, p + vec3(-2.5 * r, 2.0 * r, 0.0)) + texture(t_shadow, p + vec3(2.0 * r, 2.5 * r, 0.0)) +
               texture(t_shadow, p + vec3(2.5 * r, -2.0 * r, 0.0)) + texture(t_shadow, p + vec3(-2.0 * r, -2.5 * r, 0.0)));
#endif
  // Outside the map nothing throws a shadow. The map's own border is empty, so only depth needs a test.
  return p.z < 1.0 && sun.w > 0.5 ? 0.25 * lit : 1.0;
}
#endif

vec3 diffuse(vec3 normal, vec3 albedo, float direct) {
  return albedo * (mix(kBounceLight, kSkyLight, 0.5 + 0.5 * normal.y) + direct * kSunLight);
}

vec3 towardsEye(vec3 position) { return eye.w > 0.5 ? normalize(eye.xyz - position) : -ray_forward.xyz; }

const uint kMetallic = 3u;

// `sheen`: strength of the wide highlight of soft surfaces, 0 for dull ones.
vec3 shade(vec3 position, vec3 normal, vec3 albedo, float sheen, uint finish) {
  float direct = max(dot(normal, sun.xyz), 0.0) * sunlight(position, normal);
  vec3 color = diffuse(normal, albedo, direct);
  vec3 view = towardsEye(position);
  float h = max(dot(normal, normalize(view + sun.xyz)), 0.0);
  float h4 = h * h * h * h;
#ifdef SHINY
  // A narrow lobe, and the sky mirrored by Schlick's approximation of Fresnel's law.
  float h16 = h4 * h4 * h4 * h4, lobe = direct * h16 * h16 * h16;
  float grazing = 1.0 - max(dot(normal, view), 0.0);
  float g4 = grazing * grazing * grazing * grazing;
  float up = reflect(-view, normal).y;
  vec3 mirrored = up > 0.0 ? skyAbove(up) : skyBelow(up);
  vec3 tint = mix(albedo, vec3(1.0), 0.15 + 0.6 * g4);
  vec3 metal = 0.45 * color + tint * (mirrored * (0.35 + 0.25 * normal.y) + 1.2 * lobe);
  vec3 gloss = color + (0.04 + 0.5 * g4 * grazing) * mirrored + 0.7 * lobe * kSunLight;
  return finish == kMetallic ? metal : gloss;
#else
  return color + sheen * direct * h4 * h4 * kSunLight;
#endif
}

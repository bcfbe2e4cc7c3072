// Light on a surface: sun with soft shadow, sky from above, bounce from below, and a finish.
// Needs frame.glsl.
uniform sampler2DShadow t_shadow;

const uint kSoft = 0u, kMatte = 1u, kGlossy = 2u, kMetallic = 3u, kDead = 4u, kTranslucent = 5u;

const vec3 kSunLight = vec3(1.34, 1.22, 1.02);
const vec3 kSkyLight = vec3(0.36, 0.43, 0.54);
const vec3 kBounceLight = vec3(0.235, 0.20, 0.17);

// Part of the sun that reaches a point: bilinear comparisons on a rotated grid, which is one smooth ramp.
float sunlight(vec3 position, vec3 normal) {
  // Off the surface by more the flatter the light falls on it, against self-shadowing.
  vec3 p = (sun_from_world * vec4(position + normal * shadow.y * 1.6, 1.0)).xyz;
  if (any(lessThan(p, vec3(0.0))) || any(greaterThan(p, vec3(1.0)))) return 1.0;
  float r = shadow.x;
  float lit = texture(t_shadow, p + vec3(-0.5 * r, 1.5 * r, 0.0)) + texture(t_shadow, p + vec3(1.5 * r, 0.5 * r, 0.0)) +
              texture(t_shadow, p + vec3(0.5 * r, -1.5 * r, 0.0)) + texture(t_shadow, p + vec3(-1.5 * r, -0.5 * r, 0.0));
  if (shadow.z > 0.5)
    lit = 0.5 * lit +
          0.5 * (texture(t_shadow, p + vec3(-2.5 * r, 2.0 * r, 0.0)) + texture(t_shadow, p + vec3(2.0 * r, 2.5 * r, 0.0)) +
                 texture(t_shadow, p + vec3(2.5 * r, -2.0 * r, 0.0)) + texture(t_shadow, p + vec3(-2.0 * r, -2.5 * r, 0.0)));
  return 0.25 * lit;
}

vec3 shade(vec3 position, vec3 normal, vec3 albedo, uint finish) {
  float facing = dot(normal, sun.xyz);
  float direct = 0.0;
  if (facing > 0.0) {
    direct = facing;
    if (sun.w > 0.5) direct *= sunlight(position, normal);
  }
  if (finish == kDead) albedo = mix(vec3(dot(albedo, vec3(0.25, 0.6, 0.15))), albedo, 0.35) * 0.82;

  vec3 ambient = mix(kBounceLight, kSkyLight, 0.5 + 0.5 * normal.y);
  vec3 color = albedo * (ambient + direct * kSunLight);
  if (finish != kMatte && finish != kDead) {
    vec3 view = eye.w > 0.5 ? normalize(eye.xyz - position) : -ray_forward.xyz;
    vec3 halfway = normalize(view + sun.xyz);
    float h = max(dot(normal, halfway), 0.0);
    if (finish == kSoft) {
      float h4 = h * h * h * h;
      color += direct * 0.10 * h4 * h4 * kSunLight;
    } else {
      // A wide and a narrow lobe, and the sky mirrored by Schlick's approximation of Fresnel's law.
      float h4 = h * h * h * h, h16 = h4 * h4 * h4 * h4;
      float lobe = h16 * h16 * h16;
      float grazing = 1.0 - max(dot(normal, view), 0.0);
      float g2 = grazing * grazing;
      vec3 mirrored = sky(reflect(-view, normal));
      if (finish == kMetallic) {
        vec3 tint = mix(albedo, vec3(1.0), 0.15 + 0.6 * g2 * g2);
        color = 0.45 * color + tint * (0.55 * mirrored * (0.35 + 0.65 * ambient / kSkyLight)) + direct * lobe * 1.2 * tint;
      } else {
        color += (0.04 + 0.5 * g2 * g2 * grazing) * mirrored + direct * lobe * 0.7 * kSunLight;
      }
    }
  }
  return color;
}

// Distance hides in haze, so that a ground that ends far away does not end in a hard line.
vec3 withHaze(vec3 color, vec3 position) {
  float t = max(distance(position, eye.xyz) - fog.x, 0.0) * fog.y * eye.w;
  float t2 = t * t;
  return mix(color, kSkyHorizon, t2 / (1.0 + t2));
}

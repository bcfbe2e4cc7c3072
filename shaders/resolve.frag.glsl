// Box filter from samples to pixels, in linear light, then sRGB.
uniform sampler2D t_samples;
uniform int u_side;  // samples along a pixel's side

out vec4 o_color;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * u_side;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < u_side; ++y)
    for (int x = 0; x < u_side; ++x) {
      vec3 c = texelFetch(t_samples, first + ivec2(x, y), 0).rgb;
      sum += c * c;
    }
  vec3 linear = sum / float(u_side * u_side);
  vec3 srgb = mix(12.92 * linear, 1.055 * pow(max(linear, 1e-5), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  o_color = vec4(srgb, 1.0);
}

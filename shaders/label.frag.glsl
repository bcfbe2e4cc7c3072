// A glyph with a light halo, so that text can be read on any ground.
uniform sampler2D t_font;
uniform vec2 u_texel;  // of the font atlas

in vec2 v_uv;
flat in vec4 v_color;
out vec4 o_color;

float glyph(vec2 offset) { return texture(t_font, v_uv + offset * u_texel).a; }

void main() {
  float ink = glyph(vec2(0.0));
  float halo = ink;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) halo = max(halo, glyph(vec2(x, y)));
  float light = dot(v_color.rgb, vec3(0.3, 0.6, 0.1));
  vec3 around = light > 0.55 ? vec3(0.10, 0.11, 0.13) : vec3(1.0);
  o_color = vec4(mix(around, v_color.rgb, ink), max(ink, 0.72 * halo) * v_color.a);
}

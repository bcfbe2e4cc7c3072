// A line round the selected thing, two pixels wide, drawn where the id changes.
uniform usampler2D t_ids;
uniform uint u_selected;

out vec4 o_color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(t_ids, 0) - 1;
  float near = 0.0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      bool same = texelFetch(t_ids, clamp(at + ivec2(x, y), ivec2(0), last), 0).r == u_selected;
      near += same ? 1.0 : 0.0;
    }
  if (near < 0.5 || texelFetch(t_ids, at, 0).r == u_selected) discard;
  o_color = vec4(1.0, 0.55, 0.05, clamp(near / 5.0, 0.0, 1.0));
}

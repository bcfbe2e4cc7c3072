// Colour times texture, in display colours as the library mixes them.
uniform sampler2D t_image;

in vec2 v_uv;
in vec4 v_color;
out vec4 o_color;

void main() { o_color = v_color * texture(t_image, v_uv); }

// Shaders of the relief: a lit height field from a texture of counts, and lines of even width.

const FIELD_VERTEX = `#version 300 es
precision highp float;
precision highp int;
precision highp isampler2D;
uniform isampler2D heights;
uniform ivec2 cells;
uniform ivec2 fine;
uniform vec4 cover;
uniform float share;
uniform float lift;
uniform mat4 camera;
out float value;
out vec3 normal;
out vec2 spot;
float at(ivec2 p) { return float(texelFetch(heights, clamp(p, ivec2(0), cells - 1), 0).r); }
vec4 weights(float t) {
  return 0.5 * vec4(((2.0 - t) * t - 1.0) * t, (3.0 * t - 5.0) * t * t + 2.0, ((4.0 - 3.0 * t) * t + 1.0) * t, (t - 1.0) * t * t);
}
vec4 slopes(float t) {
  return 0.5 * vec4((4.0 - 3.0 * t) * t - 1.0, (9.0 * t - 10.0) * t, (8.0 - 9.0 * t) * t + 1.0, (3.0 * t - 2.0) * t);
}
void main() {
  ivec2 node = ivec2(gl_VertexID % fine.x, gl_VertexID / fine.x);
  spot = vec2(node) / vec2(fine - 1);
  vec2 place = spot * vec2(cells) - 0.5;
  ivec2 base = ivec2(floor(place));
  vec2 t = place - vec2(base);
  vec4 wx = weights(t.x), wy = weights(t.y), sx = slopes(t.x), sy = slopes(t.y);
  float h = 0.0;
  vec2 slope = vec2(0.0);
  for (int j = 0; j < 4; j += 1) {
    vec4 row = vec4(at(base + ivec2(-1, j - 1)), at(base + ivec2(0, j - 1)), at(base + ivec2(1, j - 1)), at(base + ivec2(2, j - 1)));
    float across = dot(wx, row);
    h += wy[j] * across;
    slope += vec2(wy[j] * dot(sx, row), sy[j] * across);
  }
  value = h * share;
  slope *= share * lift * vec2(cells) / cover.zw;
  normal = normalize(vec3(-slope, 1.0));
  gl_Position = camera * vec4(cover.xy + spot * cover.zw, value * lift, 1.0);
}`;

const FIELD_FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D colours;
uniform sampler2D mask;
uniform vec3 light;
uniform float body;
in float value;
in vec3 normal;
in vec2 spot;
out vec4 colour;
void main() {
  if (texture(mask, spot).r < 0.5) discard;
  vec3 base = texture(colours, vec2(0.5 + 0.5 * clamp(value, -1.0, 1.0), 0.5)).rgb;
  base = mix(base, vec3(0.55), body * (1.0 - min(1.0, 3.0 * abs(value))));
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  float lit = max(0.0, dot(n, light));
  float gloss = pow(max(0.0, dot(n, normalize(light + vec3(0.0, 0.0, 1.0)))), 40.0);
  colour = vec4(base * (0.42 + 0.62 * lit) + 0.1 * gloss, 1.0);
}`;

const LINE_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec2 corner;
layout(location = 3) in vec4 tint;
uniform mat4 camera;
uniform vec2 size;
uniform float width;
out vec4 shade;
void main() {
  vec4 a = camera * vec4(from, 1.0);
  vec4 b = camera * vec4(to, 1.0);
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  along = dot(along, along) > 1e-9 ? normalize(along) : vec2(1.0, 0.0);
  vec4 p = corner.x < 0.5 ? a : b;
  p.xy += vec2(-along.y, along.x) * corner.y * width / size * p.w;
  p.z -= 0.001 * p.w;
  shade = tint;
  gl_Position = p;
}`;

const LINE_FRAGMENT = `#version 300 es
precision mediump float;
in vec4 shade;
out vec4 colour;
void main() { colour = vec4(shade.rgb * shade.a, shade.a); }`;

function compile(gl, kind, source) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
    throw new Error(`a shader of the relief: ${gl.getShaderInfoLog(shader)}`);
  }
  return shader;
}

function link(gl, vertex, fragment) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`a program of the relief: ${gl.getProgramInfoLog(program)}`);
  }
  const names = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let i = 0; i < count; i += 1) {
    const { name } = gl.getActiveUniform(program, i);
    names[name] = gl.getUniformLocation(program, name);
  }
  return { program, at: names };
}

/** Both programs with the places of their uniforms. */
export function makePrograms(gl) {
  return { field: link(gl, FIELD_VERTEX, FIELD_FRAGMENT), line: link(gl, LINE_VERTEX, LINE_FRAGMENT) };
}

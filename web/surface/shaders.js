// SPDX-License-Identifier: Apache-2.0
const surfaceVertex = `#version 300 es
layout(location=0) in vec3 position; layout(location=1) in vec2 packed; layout(location=2) in vec2 uv;
uniform mat4 toView, toClip; uniform mat3 turn;
out vec3 normal, place; out vec2 at;
void main() {
  vec3 n = vec3(packed, 1. - abs(packed.x) - abs(packed.y));
  if (n.z < 0.) n.xy = (1. - abs(n.yx)) * vec2(n.x < 0. ? -1. : 1., n.y < 0. ? -1. : 1.);
  normal = turn * n;
  vec4 p = toView * vec4(position, 1.);
  place = p.xyz; at = uv;
  gl_Position = toClip * p;
}`;
const surfaceFragment = `#version 300 es
precision highp float; precision highp int; precision highp usampler2D;
in vec3 normal, place; in vec2 at; uniform mat3 turn;
uniform int mode, quantity; uniform bool perspective, borders, night; uniform float stripes, lit; uniform vec3 middle;
uniform vec2 cells, range; uniform vec4 real; uniform sampler2D palette;
uniform usampler2D raster; uniform int firstNode; uniform ivec3 sideU, sideV;  // first break, spans, cells of each
out vec4 colour;
struct Values { vec2 k; float off; vec3 normal; };
uvec4 texel(int i) { return texelFetch(raster, ivec2(i & 2047, i >> 11), 0); }
float breakAt(int i) { return uintBitsToFloat(texel(i).x); }
/* node before a part of the domain, and how far it is to the next one */
float nodeOf(ivec3 side, float t, out int node) {
  int low = 0, high = side.y;
  while (high - low > 1) {
    int middle = (low + high) >> 1;
    if (t < breakAt(side.x + middle)) high = middle; else low = middle;
  }
  float from = breakAt(side.x + low), to = breakAt(side.x + low + 1);
  float s = clamp((t - from) / (to - from), 0., 1.) * float(side.z);
  int cell = min(int(s), side.z - 1);
  node = low * (side.z + 1) + cell;
  return s - float(cell);
}
void add(inout Values sum, float weight, int node) {
  uvec4 t = texel(node);
  sum.k += weight * uintBitsToFloat(t.xy);
  sum.off += weight * uintBitsToFloat(t.w);
  int x = int(t.z << 16) >> 16, y = int(t.z) >> 16;
  if (x < -32767) return;
  vec2 p = vec2(x, y) / 32767.;
  vec3 n = vec3(p, 1. - abs(p.x) - abs(p.y));
  if (n.z < 0.) n.xy = (1. - abs(n.yx)) * vec2(n.x < 0. ? -1. : 1., n.y < 0. ? -1. : 1.);
  sum.normal += weight * normalize(n);
}
Values valuesAt(vec2 part) {
  int i, j;
  float f = nodeOf(sideU, part.x, i), g = nodeOf(sideV, part.y, j);
  int row = sideU.y * (sideU.z + 1), first = firstNode + j * row + i;
  Values sum = Values(vec2(0.), 0., vec3(0.));
  add(sum, (1. - f) * (1. - g), first);
  add(sum, f * (1. - g), first + 1);
  add(sum, (1. - f) * g, first + row);
  add(sum, f * g, first + row + 1);
  return sum;
}
float line(float t, float width) {
  float w = max(fwidth(t), 1e-9);
  return (1. - smoothstep(width - .5, width + .5, abs(fract(t - .5) - .5) / w)) * (1. - smoothstep(.25, .6, w));
}
float border() {
  vec2 w = max(fwidth(at), vec2(1e-9));
  vec4 e = vec4(at.x / w.x, (1. - at.x) / w.x, at.y / w.y, (1. - at.y) / w.y) + 9. * (1. - real);
  return 1. - smoothstep(.6, 1.6, min(min(e.x, e.y), min(e.z, e.w)));
}
vec3 lighted(vec3 base, vec3 n, vec3 v) {
  vec3 key = normalize(vec3(-.62, .58, .52)), fill = normalize(vec3(.85, -.05, .40));
  float sky = .5 + .5 * n.y, gloss = pow(max(dot(n, normalize(key + v)), 0.), 60.);
  float rim = pow(1. - clamp(dot(n, v), 0., 1.), 4.);
  vec3 around = mix(vec3(.13, .13, .14), vec3(.25, .27, .30), sky);
  float lit = max(dot(n, key), 0.);
  return base * (around + .80 * lit * (.55 + .45 * lit) + .13 * max(dot(n, fill), 0.)) + .07 * gloss + .05 * rim;
}
void main() {
  vec3 v = perspective ? normalize(-place) : vec3(0., 0., 1.);
  Values here = valuesAt(at);
  vec3 n = normalize(dot(here.normal, here.normal) > .25 ? turn * here.normal : normal);
  if (!gl_FrontFacing) n = -n;
  vec3 front = night ? vec3(.42, .56, .72) : vec3(.45, .61, .79), back = night ? vec3(.62, .48, .34) : vec3(.80, .65, .46);
  vec3 base = gl_FrontFacing ? front : back;
  vec3 ink = vec3(.012, .025, .045);
  vec3 c;
  if (mode == 2) {
    float k1 = here.k.x, k2 = here.k.y;
    float value = quantity == 0 ? k1 * k2 : quantity == 1 ? .5 * (k1 + k2) : quantity == 2 ? k1 : quantity == 3 ? k2 : here.off;
    float part = range.y > range.x ? (value - range.x) / (range.y - range.x) : .5;
    c = pow(texture(palette, vec2(clamp(part, .002, .998), .5)).rgb, vec3(2.2));
    c *= .80 + .20 * max(dot(n, normalize(vec3(-.2, .5, .85))), 0.);
  } else if (mode >= 3 && mode <= 5) {
    vec3 r = reflect(-v, n);
    float s = asin(clamp(r.y, -1., 1.)) * stripes / 3.14159265;
    if (mode == 4) s = acos(clamp(dot(n, v), -1., 1.)) * 2. * stripes / 3.14159265;
    if (mode == 5) {  // lamps along a ceiling two radii above the middle
      vec3 p = place - middle;
      float reach = r.y > 1e-6 ? (p.x + (2. - p.y) * r.x / r.y) / 2. : sign(r.x) * 1e6;
      s = clamp(stripes * reach, -stripes - .5, stripes + .5);
    }
    float w = max(fwidth(s), 1e-6);
    float d = abs(fract(s) - .5) - .25;
    float white = mix(clamp(.5 + d / w, 0., 1.), .5, smoothstep(.5, 1., w));
    c = mix(vec3(.018, .028, .045), vec3(.86, .89, .92), white) * (.82 + .18 * n.z);
    if (!gl_FrontFacing) c *= vec3(1., .93, .82);
  } else {
    c = lighted(base, n, v);
    if (mode == 1) {
      c = mix(c, vec3(.75, .78, .82) * (.45 + .55 * max(n.z, 0.)), night ? .15 : .45);
      c = mix(c, vec3(.01, .10, .34), .92 * line(at.x * cells.x, .75));
      c = mix(c, vec3(.42, .07, .02), .92 * line(at.y * cells.y, .75));
    }
  }
  if (borders) c = mix(c, ink, .72 * border());
  c = mix(c, vec3(1., .62, .12), .45 * lit);
  colour = vec4(pow(max(c, 0.), vec3(1. / 2.2)), 1.);
}`;
const dotVertex = `#version 300 es
layout(location=0) in vec3 position; layout(location=1) in float value;
uniform mat4 toView, toClip; uniform float size, nearer; uniform vec2 range; out float part;
void main() {
  gl_Position = toClip * (toView * vec4(position, 1.));
  gl_Position.z -= nearer * gl_Position.w;
  gl_PointSize = size;
  part = range.y > range.x ? (value - range.x) / (range.y - range.x) : .5;
}`;
const dotFragment = `#version 300 es
precision highp float; in float part; uniform sampler2D palette; out vec4 colour;
void main() {
  if (length(gl_PointCoord - .5) > .5) discard;
  colour = vec4(texture(palette, vec2(clamp(part, .002, .998), .5)).rgb, 1.);
}`;
const lineVertex = `#version 300 es
layout(location=0) in vec3 position; uniform mat4 toView, toClip; uniform float nearer;
void main() { gl_Position = toClip * (toView * vec4(position, 1.)); gl_Position.z -= nearer * gl_Position.w; }`;
const lineFragment = `#version 300 es
precision highp float; uniform vec4 ink; out vec4 colour;
void main() { colour = vec4(ink.rgb * ink.a, ink.a); }`;

// Common light, from the upper left behind the camera. Vectors are in camera coordinates.

// Haze: what is farther than the middle of the picture fades towards the colour of the paper.
export const HAZE = `
uniform vec4 haze;   // colour of the paper, and distance of the middle of the picture
vec3 hazed(vec3 lit, float distance, float most) { return mix(lit, haze.rgb, most * clamp((distance / haze.w - 1.0) / 0.6, 0.0, 1.0)); }`;

export const SHADE = `
uniform float darkness;
vec3 shade(vec3 base, vec3 normal, vec3 towards) {
  vec3 light = normalize(vec3(-0.35, 0.6, 0.72));
  float facing = clamp(dot(normal, towards), 0.0, 1.0);
  float diffuse = 0.5 + 0.5 * dot(normal, light);
  float bright = pow(clamp(dot(normal, normalize(light + towards)), 0.0, 1.0), 42.0);
  vec3 lit = base * (0.46 + 0.66 * diffuse * diffuse) + 0.22 * bright;
  // The rim contrasts with a white and with a black background.
  float rim = pow(1.0 - facing, 4.0);
  return mix(lit, darkness > 0.5 ? mix(lit, vec3(0.85, 0.92, 1.0), 0.6) : lit * 0.45, 0.8 * rim);
}`;

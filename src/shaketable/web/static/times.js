// The times of a film.

export const RATE = 60; // frames a second
export const LIES = 0.5; // s that a fall in a plane goes on after its last frame, until it lies

// Of a film, frames a second.
export const rateOf = (film) => film.rate_hz ?? RATE;

const frames = (film) => film.pictures ?? (film.frames.rotation_deg ?? film.frames.quaternion).length;

export function lengthOf(film) {
  const falls = film.frames?.rotation_deg && film.outcome !== "standing";
  return (frames(film) - 1) / rateOf(film) + (falls ? LIES : 0);
}

// When the film becomes worth watching: just before the ground is a twentieth as strong as ever.
export function startOf(film) {
  const { acceleration_g, time_step_s, peak_g } = film.ground;
  const first = acceleration_g.findIndex((a) => Math.abs(a) >= 0.05 * peak_g);
  return Math.max(0, Math.min(first * time_step_s - 0.5, lengthOf(film) - 1));
}

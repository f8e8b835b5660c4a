"""
What a magnitude 7 at 20 km does
================================

Ground-motion models give the spectrum of an earthquake and its scatter; artificial motions have
both. (The extra ``scenario`` brings the ground-motion models.)
"""

from shaketable import Body, Outcome, simulate_many
from shaketable.hazard import artificial_motions, ln_spectra_of, scenario, target_of
from shaketable.plot import plot_target
from shaketable.resampling import wilson_interval

quake = scenario(magnitude=7.0, distance_km=20.0, vs30=400.0)
target = target_of(quake)
motions = artificial_motions(quake, 64)
plot_target(target, ln_spectra_of(motions, target.periods))

# %%
# Both polarities of each motion shake a bookcase.
runs = simulate_many([Body.rectangle(0.32, 1.80)], motions, progress=False)
fell = int((runs.outcome != Outcome.STANDING).any("polarity").sum())
low, high = wilson_interval(fell / len(motions), len(motions))
print(f"falls in {fell} of {len(motions)} motions ({low:.0%} to {high:.0%}), in some polarity")

#!/usr/bin/env bash
# questplus 2019.4 (Debian 12's python3-questplus): its cumulative normal has lower asymptote and lapse
# rate exchanged, so that a forced choice between two looks like one that nobody gets right.
#
# Both psychometric functions of the package take `lower_asymptote` (.5 in a choice between two) and
# `lapse_rate` by these names. The Weibull function runs from .5 to .98 for .5 and .02, as it should;
# `norm_cdf` runs from .02 to .5. Nothing is said. With the defaults, .01 and .01, and in a yes-no task
# with as many false alarms as lapses, the two are one, so that a first try looks right. A staircase of
# a choice between two then takes every right answer for a lucky one: after 150 answers of a simulated
# observer with the threshold 0 it believes in the lowest threshold that it was given, 1.5 off, with a
# deviation of .01, and has asked where there is nothing to be seen. By the Weibull function (whose
# threshold is at 63 % of the way, here .17) the same set-up ends within its deviation of the truth.
# Until that is mended, give `norm_cdf` the two exchanged, or use it where they are equal.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q python3-questplus=2019.4-6 python3-json-tricks=3.11.0-4 \
    python3-xarray=2023.01.0-1.1 python3-pandas=1.5.3+dfsg-2 python3-pandas-lib=1.5.3+dfsg-2 \
    python3-numpy=1:1.24.2-1+deb12u1 python3-scipy=1.10.1-2 python3-dateutil=2.8.2-2 \
    python3-tz=2022.7.1-4 python3-six=1.16.0-4 python3-packaging=23.0-1 python3-decorator=5.1.1-3 \
    libblas3=3.11.0-2 liblapack3=3.11.0-2 liblbfgsb0=3.0+dfsg.4-1 libgfortran5=12.2.0-14+deb12u1 \
    libquadmath0=12.2.0-14+deb12u1 >/dev/null 2>&1
for package in ./*.deb; do
    dpkg-deb -x "$package" root
done
library=$folder/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$library:$library/blas:$library/lapack
export PYTHONPATH=$folder/root/usr/lib/python3/dist-packages

cat >staircase.py <<'CODE'
import questplus
import numpy as np
from questplus.psychometric_function import norm_cdf, weibull
import scipy.stats

GUESSES, LAPSES = 0.5, 0.02
LEVELS = np.linspace(-2, 2, 41)


def ends(function, **shape):
    values = function(intensity=[-50, 50], lower_asymptote=GUESSES, lapse_rate=LAPSES, **shape)
    return [round(float(v), 3) for v in values.squeeze().values]


def staircase(function, scale, domain):
    """The threshold after 150 answers to it, its deviation, and the median level asked for."""
    quest = questplus.QuestPlus(
        stim_domain={"intensity": LEVELS}, param_domain=domain,
        outcome_domain={"response": ["right", "wrong"]}, func=function, stim_scale=scale)
    random = np.random.default_rng(7)
    asked = []
    for _ in range(150):
        level = quest.next_stim["intensity"]
        asked.append(level)
        share = GUESSES + (1 - GUESSES - LAPSES) * scipy.stats.norm.cdf(level / 0.5)
        answer = "right" if random.random() < share else "wrong"
        quest.update(stim={"intensity": level}, outcome={"response": answer})
    name = "mean" if "mean" in domain else "threshold"
    belief = quest.marginal_posterior[name]
    places = domain[name]
    mean = float(np.sum(belief * places))
    deviation = float(np.sqrt(np.sum(belief * (places - mean) ** 2)))
    return mean, deviation, float(np.median(asked))


places = np.linspace(-1.5, 1.5, 31)
weibull_ends = ends(weibull, threshold=0, slope=3.5, scale="log10")
normal_ends = ends(norm_cdf, mean=0, sd=0.5)
shared = {"lower_asymptote": [GUESSES], "lapse_rate": [LAPSES]}
by_weibull = staircase("weibull", "log10", {"threshold": places, "slope": [1.0, 1.5, 2.0, 3.0], **shared})
by_normal = staircase("norm_cdf", "linear", {"mean": places, "sd": [0.25, 0.5, 1.0], **shared})
print("questplus 2019.4, lower asymptote .5, lapse rate .02")
print(f"weibull   from {weibull_ends[0]} to {weibull_ends[1]}; threshold {by_weibull[0]:+.2f} "
      f"+- {by_weibull[1]:.2f}, asked at {by_weibull[2]:+.1f}")
print(f"norm_cdf  from {normal_ends[0]} to {normal_ends[1]}; threshold {by_normal[0]:+.2f} "
      f"+- {by_normal[1]:.2f}, asked at {by_normal[2]:+.1f}")
as_stated = (weibull_ends == [0.5, 0.98] and normal_ends == [0.02, 0.5]
             and abs(by_weibull[0] - 0.17) < 0.2 and by_normal[0] < -1.3 and by_normal[1] < 0.1)
print("as stated" if as_stated else "NOT as stated: this finding is out of date")
raise SystemExit(0 if as_stated else 1)
CODE
python3 -W ignore staircase.py

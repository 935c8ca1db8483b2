"""Curves of one point of the law `unloading: "closing"` in rate form (docs/CLOSING.md): no return mapping.

    closing.py c07_open_press_shear.json          integrates the curve of that name and writes the file
    closing.py --check c01.json c02.json ...      integrates the programs of stored curves and prints the differences

Straight legs in (u_n, u_t), extrapolation of order 16 (Gragg, Bulirsch, Stoer), every change of mode located as an event.
Without dilatancy (sigma_dil = 0) the faces touch at u_n = 0 for ever: the gap g is u_n. A dash is d/dx along a leg.

Elastic: tau = K_T (u_t - u_t^p) and sigma = K_N g (g < 0), k g (0 <= g <= g_e), K_N (g - o) (beyond the anchor g_e). Instead of
k the stress sigma_e at the anchor is carried, which is never 0/0:

    g_e = o + sigma_e/K_N,   k = sigma_e/g_e (K_N if o = 0),   energy of the bridges B = sigma_e o/2

Flow with b = c - chi t, s = sqrt(tau^2 + b^2), n = tau/s, F_W = b b_W/s - c_W + sigma t_W, w = sigma t + n tau:

    T   l' = (t k_e g' + n K_T u_t') / (t^2 K_N + n^2 K_T - F_W w),   W' = l' w,   u_t^p' = l' n,   o' = l' t
        T= at the anchor  k_e = K_N  sigma_e = sigma                      D' = (sigma o' - sigma' o)/2 + tau u_t^p'
        T> beyond it      k_e = K_N  sigma_e' = (2 sigma - sigma_e) o'/o  D' = tau u_t^p'  (B' = sigma o', the secant k_B)
        T< below it       k_e = k    k = sigma/g, k' = -K_N o'/g          D' = g K_N o'/2 + tau u_t^p'
    Z   sigma = k = 0, u_t^p' = K_T u_t'/(K_T - F_W s), W' = D' = tau u_t^p';   Z< g < o: o' = 0;   Z= g = o: o' = g' <= l' t
    C   sigma = K_N g, |tau| = tau_y(sigma, W), a = |tau| + sigma t, W' = a v, D' = |tau| v, o' = k' = 0 with the slip rate
        v = (sgn(tau) u_t' - (d tau_y/d sigma) sigma'/K_T) / (1 + a (d tau_y/dW)/K_T)
    A   spent (W = G_I) and open: sigma = tau = k = 0, o = g, u_t^p = u_t until the faces touch;   E: nothing flows

Flow does not end within a leg: where l' vanishes, l'' is d2F/dx2 of the elastic path times a positive number, and F is convex.
So unloading is met where a leg or a branch of sigma(g) begins. Square roots: towards parting (if chi = 0, tau ~ sqrt(-sigma))
C is integrated over z, x = x_0 - z^2; in Z (tau ~ sqrt(G_I - W)) tau is integrated along with W, and tau = 0 is the event.
Faces that part while slipping (g = 0, F = 0, k > 0) take at once k = min(k, k*), where l' vanishes on the secant:
k* = max(0, -n K_T u_t'/(t g')), since dk/d(ln g) = -K_N t l'/g'. Done for k* = 0 and k* >= k, refused between.
"""

import json
import sys
from pathlib import Path

import numpy as np

np.seterr(all="ignore")  # a trial step may leave the surface, it is then made shorter
SIGMA, TAU, W, O, ANCHOR, D, WORK = range(7)  # the state: stresses, history, opening o, sigma_e, dissipation, work done
COLUMNS, ON_SURFACE, AT, SPENT = 8, 1e-10, 1e-17, 1e-14  # of the extrapolation; MPa; m; part of G_I
KEYS = "sigma", "tau", "W", "opening", "bridge_stiffness", "up_t"
PARAMETERS = {"alpha_chi": 0.0, "alpha_c": 0.0, "alpha_phi": 0.0, "alpha_sdil": 0.0, "alpha_cdil": 0.0, "kn": 1e6, "kt": 1e6}
PARAMETERS |= {"tanphi0": 0.8785, "chi0": 3.0, "c0": 4.0, "gf1": 2e-4, "gf2a": 2e-3, "sigma_dil": 0.0, "tanphi_res": 0.6}
CORNERS = [(0, 0), (4.4e-5, 8e-6), (-6e-6, 8e-6), (-6e-6, 3.2e-5), (-6e-6, 2.45e-5), (1e-4, 2.45e-5), (5e-5, 2.5e-5)]
CORNERS += [(5e-5, 3.3e-5), (1.6e-4, 3.3e-5)]  # (u_n, u_t) in m
CURVES = {
    "c07_open_press_shear": ("opened, closed, pressed, sheared, opened again, closed halfway, slid at that gap, opened on", {}),
    "c08_same_with_exponents": ("the program of c07 with exponents", {"alpha_chi": 0.3, "alpha_c": -0.4, "alpha_phi": 0.2}),
}
MODES = {"E": "no flow", "T": "flow, sigma>0", "C": "flow, sigma<0", "Z": "flow, sigma held at 0", "A": "spent and open"}
UNITS = {"stress": "MPa", "length": "m", "stiffness": "MPa/m", "energy": "MPa*m (= 1000 N/mm)"}
SIGN = "sigma > 0 tension, u_n > 0 opening, s in [k,k+1] runs linearly over segment k of the program"


def shape(part, alpha):
    """S and its derivative, continued smoothly beyond 1: events say where it ends."""
    e = np.exp(-alpha)
    below = 1 + (e - 1) * part
    return e * part / below, e / below**2


def extrapolated(rates, z, y, h):
    """A step by the midpoint rule in 2, 4, 6, ... parts, extrapolated to infinitely many; and the last correction."""
    begin, row = rates(z, y), []
    for parts in range(2, 2 * COLUMNS + 1, 2):
        step = h / parts
        older, newer = 0.0, step * begin
        for part in range(1, parts):
            older, newer = newer, older + 2 * step * rates(z + part * step, y + newer)
        last, row = row, [newer]
        for column, coarse in enumerate(last):
            row.append(row[-1] + (row[-1] - coarse) / ((parts / (parts - 2 - 2 * column)) ** 2 - 1))
    return y + row[-1], abs(row[-1] - row[-2])


class Point:
    """A law point that is driven along straight legs."""

    def __init__(self, parameters, tolerance):
        self.p = p = parameters
        self.kn, self.kt, self.gi, self.loss = p["kn"], p["kt"], p["gf1"], p["tanphi0"] - p["tanphi_res"]
        self.y, self.spent, self.slip, self.switches, self.worst = np.zeros(7), False, 0.0, [], 0.0
        self.allowed = tolerance * np.array([p["c0"], p["c0"], self.gi, p["c0"] / self.kn, p["c0"], self.gi, self.gi])

    def strengths(self, w):
        """chi, c, t and their derivatives with respect to W."""
        p = self.p
        chi, dchi = (1.0, 0.0) if self.spent else shape(w / self.gi, p["alpha_chi"])
        (c, dc), (t, dt) = shape(w / p["gf2a"], p["alpha_c"]), shape(w / p["gf2a"], p["alpha_phi"])
        values = p["chi0"] * (1 - chi), p["c0"] * (1 - c), p["tanphi0"] - self.loss * t
        return *values, -p["chi0"] * dchi / self.gi, -p["c0"] * dc / p["gf2a"], -self.loss * dt / p["gf2a"]

    def jump(self, x):
        """u_n, which is the gap, and u_t."""
        return self.start + self.du * x

    def bridge(self):
        """Secant k and anchor g_e."""
        o, anchor = self.y[O], self.y[O] + self.y[ANCHOR] / self.kn
        return (self.y[ANCHOR] / anchor, anchor) if o > 0 else (self.kn, 0.0)

    def surface(self):
        """F and n."""
        chi, c, t = self.strengths(self.y[W])[:3]
        s = np.hypot(self.y[TAU], c - chi * t)
        return s - c + self.y[SIGMA] * t, self.y[TAU] / s

    def complete(self, mode, x, y):
        """Fills in what a mode gives algebraically."""
        y, g = y.copy(), self.jump(x)[0]
        if mode == "C":
            chi, c, t = self.strengths(y[W])[:3]
            y[SIGMA] = self.kn * g
            y[TAU] = self.sign * np.sqrt(t * (chi - y[SIGMA]) * (2 * c - t * (chi + y[SIGMA])))
        elif mode in ("T=", "T>", "Z="):
            y[O] = g - y[SIGMA] / self.kn
            y[ANCHOR] = y[ANCHOR] if mode == "T>" else y[SIGMA]
        elif mode == "T<":
            y[ANCHOR] = y[O] * y[SIGMA] / (g - y[SIGMA] / self.kn)
        return y

    def rates(self, mode, x, y):
        """dy/dx."""
        y, (dg, dv), rate = self.complete(mode, x, y), self.du, np.zeros(7)
        sigma, tau, kn, kt, g = y[SIGMA], y[TAU], self.kn, self.kt, self.jump(x)[0]
        chi, c, t, dchi, dc, dt = self.strengths(y[W])
        b, db = c - chi * t, dc - dchi * t - chi * dt
        rate[WORK] = sigma * dg + tau * dv
        if mode == "C":
            room, a = c - sigma * t, abs(tau) + sigma * t
            by_sigma, by_w = -t * room / abs(tau), (room * (dc - sigma * dt) - b * db) / abs(tau)
            slip = (self.sign * dv - by_sigma * kn * dg / kt) / (1 + a * by_w / kt)
            rate[[W, D]] = a * slip, abs(tau) * slip
            return rate
        s = np.hypot(tau, b)
        n, f_w = tau / s, b * db / s - dc + sigma * dt
        if mode[0] == "Z":
            slip = kt * dv / (kt - f_w * s)
            rate[[TAU, W, D]] = kt * (dv - slip), tau * slip, tau * slip
            return rate
        w, slope = sigma * t + n * tau, sigma / g if mode == "T<" else kn
        stiff = t**2 * kn + n**2 * kt - f_w * w
        if stiff <= 0:
            raise ValueError(f"snap back at x = {x}")
        flow = (t * slope * dg + n * kt * dv) / stiff
        opening, slip = flow * t, flow * n
        rate[SIGMA] = (slope * dg * (n**2 * kt - f_w * w) - kn * t * n * kt * dv) / stiff
        rate[TAU] = kt * (dv * (t**2 * kn - f_w * w) - n * t * slope * dg) / stiff
        bridges = {"T=": (sigma * opening - rate[SIGMA] * y[O]) / 2, "T>": 0.0, "T<": g * kn * opening / 2}[mode]
        rate[[W, O, D]] = flow * w, opening, bridges + tau * slip
        if mode == "T>":
            rate[ANCHOR] = (2 * sigma - y[ANCHOR]) * opening / y[O]
        return rate

    def margins(self, mode, x, y):
        """What stays positive as long as the mode goes on, by the name of the event that ends it."""
        y, rate = self.complete(mode, x, y), self.rates(mode, x, y)
        if mode == "C":
            return {} if self.spent else {"spent": self.gi - y[W]}
        if mode == "Z<":
            return {"spent": self.sign * y[TAU]}
        if mode == "Z=":
            c, t = self.strengths(y[W])[1:3]
            return {"spent": self.sign * y[TAU], "T>": abs(self.du[1] - rate[TAU] / self.kt) * c * t - self.du[0] * abs(y[TAU])}
        if mode == "T=":
            lag = y[SIGMA] * rate[O] - rate[SIGMA] * y[O]
            return {"zero": y[SIGMA], "spent": self.gi * (1 - SPENT) - y[W], "T>": lag}
        below = y[SIGMA] - self.kn * (self.jump(x)[0] - y[O]) if self.du[0] > 0 else 1.0
        return {"zero": y[SIGMA], "anchor": y[SIGMA] - y[ANCHOR] if mode == "T>" else below}

    def branch(self, x):
        """The branch of sigma(g) that is entered, its slope and its stress."""
        g, dg, (k, anchor) = self.jump(x)[0], self.du[0], self.bridge()
        if g < -AT or (g <= AT and dg < 0):
            return "contact", self.kn, self.kn * g
        below = g < anchor - AT or (g <= anchor + AT and dg < 0)
        return ("secant", k, k * g) if below else ("beyond", self.kn, self.kn * (g - self.y[O]))

    def choose(self, x):
        """The mode that is entered."""
        y, (dg, dv), (branch, slope, _), (f, n) = self.y, self.du, self.branch(x), self.surface()
        if self.spent and branch != "contact":
            return "A"
        normal, shear = self.strengths(y[W])[2] * slope * dg, n * self.kt * dv
        if f < -ON_SURFACE or normal + shear < 0 or (normal + shear == 0 and dv == 0):
            return "E"
        if branch == "secant" and self.jump(x)[0] <= AT and slope > 0:
            if shear < 0:
                raise ValueError("faces part while slipping back: 0 < k* < k")
            y[ANCHOR] = 0.0
            return self.choose(x)
        self.sign = np.sign(y[TAU])
        if branch == "contact":
            return "C"
        if branch == "secant":
            return "T<" if y[SIGMA] > 0 else "Z<"
        if y[SIGMA] == 0 and shear > 0 and self.margins("Z=", x, y)["T>"] >= 0:
            return "Z="
        at_anchor = y[O] == 0 or y[ANCHOR] >= y[SIGMA] * (1 - 1e-12) > 0
        y[ANCHOR] = min(y[ANCHOR], y[SIGMA])
        return "T=" if at_anchor and self.margins("T=", x, y)["T>"] >= 0 else "T>"

    def rest(self, x, target):
        """Elastic to the target, the next corner of sigma(g) or the onset of flow; or spent and open until the faces touch."""
        y, (dg, dv), g = self.y, self.du, self.jump(x)[0]
        ways = [(at - g) / dg for at in (0.0, self.bridge()[1])[: 1 + (self.mode == "E")] if dg and abs(at - g) > AT]
        way = min([target - x, *[way for way in ways if way > 0]])
        if self.mode == "A":
            g, self.slip = self.jump(x + way)
            y[[SIGMA, TAU, ANCHOR, O]] = 0.0, 0.0, 0.0, 0.0 if dg < 0 and g <= AT else g
            return x + way
        _, slope, y[SIGMA] = self.branch(x)
        chi, c, t = self.strengths(y[W])[:3]
        s, room, narrowing = np.hypot(y[TAU], c - chi * t), c - t * y[SIGMA], -t * slope * dg
        square, half = (self.kt * dv) ** 2 - narrowing**2, y[TAU] * self.kt * dv - room * narrowing
        if abs(s - room) <= ON_SURFACE:
            onset = -2 * half / square if square > 0 > half else np.inf
        else:
            below = half + np.sqrt(half**2 - square * (s - room) * (s + room))
            onset = (room - s) * (room + s) / below if below > 0 else np.inf
        way = min(way, onset)
        sigma, tau = y[SIGMA] + slope * dg * way, y[TAU] + self.kt * dv * way
        y[WORK] += ((sigma + y[SIGMA]) * dg + (tau + y[TAU]) * dv) * way / 2
        y[[SIGMA, TAU]] = sigma, tau
        return x + way

    def flow(self, x, target):
        """Integrates the mode up to the target, a known stop or an event; returns where, and the next mode if it is known."""
        mode, dg, g = self.mode, self.du[0], self.jump(x)[0]
        stops = {"C": [0.0], "Z<": [0.0, self.y[O]]}.get(mode, [])
        stops = [x + (at - g) / dg for at in stops if dg and (at - g) / dg > 0 and abs(at - g) > AT]
        end = min([target, *stops])
        parting = stops[0] if mode == "C" and stops else None
        place = (lambda z: parting - z * z) if parting else (lambda z: z)
        z, z_end = (np.sqrt(parting - x), np.sqrt(parting - end)) if parting else (x, end)

        def step(h):
            new, error = extrapolated(lambda z, y: self.rates(mode, place(z), y) * (-2 * z if parting else 1), z, self.y, h)
            return self.complete(mode, place(z + h), new), np.max(error / self.allowed)

        h = (z_end - z) / 4
        while z != z_end:
            last = abs(h) >= 0.999 * abs(z_end - z)
            h = z_end - z if last else h
            new, error = step(h)
            if error <= 1:
                ended = [name for name, margin in self.margins(mode, place(z + h), new).items() if margin < 0]
                if ended:
                    return self.settle(mode, step, ended, lambda h: place(z + h), h)
                self.y, z = new, z_end if last else z + h
            h *= min(4.0, max(0.2, 0.9 * max(error, 1e-12) ** (-1 / (2 * COLUMNS - 1)))) if np.isfinite(error) else 0.2
        self.y[SIGMA] *= end != parting
        return end, mode if end == target else None

    def settle(self, mode, step, ended, place, h):
        """Finds the first event by bisection and puts the state exactly on it."""
        low, high = 0.0, h
        while low < (middle := (low + high) / 2) < high or high < middle < low:
            margins = self.margins(mode, place(middle), step(middle)[0])
            past = [name for name, margin in margins.items() if margin < 0]
            low, high, ended = (low, middle, past) if past else (middle, high, ended)
        self.y, event = step(high)[0], ended[0]
        y = self.y
        if event == "spent":
            y[W], self.spent, y[ANCHOR] = self.gi, True, 0.0
            y[[SIGMA, TAU]] *= mode == "C"
            y[O] *= mode != "C"
        elif event == "zero":
            y[[SIGMA, ANCHOR]] = 0.0
        return place(high), event if event == "T>" else None

    def leg(self, number, start, end, points):
        """Drives the point along a leg and returns the points on it."""
        self.start, self.du, self.mode, x, found = np.array(start), np.subtract(end, start), None, 0.0, []
        for target in (np.arange(points) + 1) / points:
            while x < target:
                now = self.mode = self.mode or self.choose(x)
                self.switches.append({"segment": number, "s_from": x, "mode": now[0]})
                x, self.mode = (self.rest(x, target), None) if now in "EA" else self.flow(x, target)
                self.slip = self.slip if now in "EA" else self.jump(x)[1] - self.y[TAU] / self.kt
                self.worst = max(self.worst, self.surface()[0])
                if [(last["segment"], last["mode"]) for last in self.switches[-2:-1]] == [(number, now[0])]:
                    self.switches.pop()
                self.switches[-1] |= {"s_to": x, "W_end": self.y[W]}
            found.append(self.record(number, x, now))
        return found

    def record(self, number, x, mode):
        """A point of the curve."""
        y, (g, u_t), (k, anchor) = self.y, self.jump(x), self.bridge()
        stored = self.kn * g**2 if g < 0 else k * g**2 if g <= anchor else self.kn * (g - y[O]) ** 2 + y[ANCHOR] * y[O]
        found = {"s": number + x, "u_n": g, "u_t": u_t, "sigma": y[SIGMA], "tau": y[TAU], "W": y[W], "dilation": 0.0}
        found |= {"opening": y[O], "bridge_stiffness": k, "up_t": self.slip, "dissipation": y[D]}
        return found | {"stored": (stored + y[TAU] ** 2 / self.kt) / 2, "work": y[WORK], "mode": mode[0]}


def integrate(parameters, program, tolerance):
    """The points of a program and the law point at its end."""
    law, points = Point(parameters, tolerance), []
    for number, leg in enumerate(program):
        points += law.leg(number, *([leg[axis][end] for axis in "nt"] for end in ("start", "end")), leg["points"])
    begin = dict.fromkeys(points[0], 0.0) | {"bridge_stiffness": law.kn, "mode": "E"}
    return [begin, *points], law


def apart(points, others, *keys):
    """Largest difference of two curves."""
    return max(abs(a[key] - b[key]) for a, b in zip(points, others, strict=True) for key in keys)


def curve(name, about, parameters, program):
    """Integrates a program to three tolerances and returns the content of a reference file."""
    (points, law), (fine, _), (coarse, _) = (integrate(parameters, program, tolerance) for tolerance in (1e-13, 1e-12, 1e-10))
    start = {key: points[0][key] for key in ("u_n", "u_t", "dilation", "opening", "bridge_stiffness", "up_t", "W")}
    changes = {"1e10": apart(points, coarse, "sigma", "tau"), "1e12": apart(points, fine, "sigma", "tau")}
    accuracy = {f"change_when_tolerance_1e13_to_{to}": change for to, change in changes.items()}
    energy = {key: points[-1][key] for key in ("work", "stored", "dissipation")}
    residual = max(abs(point["work"] - point["stored"] - point["dissipation"]) for point in points) / energy["work"]
    file = {"name": name, "description": about, "unloading": "closing", "riding_slope": 2.0, "units": UNITS, "sign": SIGN}
    file |= {"parameters": parameters, "initial": start | {"slip_open": 0.0}, "program": program, "mode_legend": MODES}
    file |= {"accuracy": accuracy | {"max_F_MPa": law.worst}, "energy": energy | {"largest_residual_over_work": residual}}
    return file | {"mode_switches": law.switches, "points": points}


def main():
    """Writes a curve or checks stored ones."""
    for file in map(Path, sys.argv[2:] if sys.argv[1] == "--check" else []):
        stored = json.loads(file.read_text())
        found = curve(stored["name"], "", stored["parameters"], stored["program"])
        differences = [f"{key} {apart(found['points'], stored['points'], key):.1e}" for key in KEYS]
        modes = [[(switch["segment"], switch["mode"]) for switch in curve["mode_switches"]] for curve in (found, stored)]
        same = "same modes" if modes[0] == modes[1] else f"modes {modes}"
        print(stored["name"], *differences, same, json.dumps(found["accuracy"] | found["energy"], default=float), sep="\n    ")
    if sys.argv[1] != "--check":
        name, program = Path(sys.argv[1]).stem, []
        for corners in zip(CORNERS[:-1], CORNERS[1:], strict=True):
            ends = [{"control": "displacement", "start": float(a), "end": float(b)} for a, b in zip(*corners, strict=True)]
            program.append(dict(zip("nt", ends, strict=True)) | {"points": 8})
        about, exponents = CURVES[name]
        file = curve(name, about, PARAMETERS | exponents, program)
        Path(sys.argv[1]).write_text(json.dumps(file, indent=1, default=float) + "\n")


if __name__ == "__main__":
    main()

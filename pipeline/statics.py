"""Do forces balance: loads, reactions and the tractions of the interfaces, integrated from the VTUs."""

import numpy as np

from joints import subdomains_of

BALANCE = 1e-10  # of the largest force; where the solution is iterated, no better than its own residual


def resultant(grid, thickness):
    """Force of side B on side A: the tractions summed over the law points."""
    normal = grid["normal"][:, :2]
    tangent = np.column_stack([normal[:, 1], -normal[:, 0]])
    traction = grid["traction"][:, :1] * normal + grid["traction"][:, 1:] * tangent
    return thickness * grid["length"] @ traction


def summed(grid, thickness):
    """The same by magnitude."""
    return thickness * grid["length"] @ np.hypot(*grid["traction"].T)


def check_balance(results, scene, summary, interfaces, residual, faults):
    """Forces on the whole model and on each subdomain sum to zero. Returns the largest error of either."""
    allowed, equilibrium = max(BALANCE, residual), summary["equilibrium"]
    forces = {name: [own["load"], own["reaction"]] for name, own in equilibrium["subdomains"].items()}
    # of a joint its tractions count, not their sum alone: that of a bent arm is a small part of what it carries
    joints = [summed(grid, scene.get("thickness", 1.0)) for grid in interfaces.values()]
    size = max(np.abs(list(forces.values())).max(initial=np.finfo(float).tiny), *joints, 0.0)

    def error(parts):
        return np.abs(np.sum(parts, axis=0)).max() / size

    whole = error([equilibrium["load"], equilibrium["reaction"]])
    faults.expect(whole <= allowed, f"{results}: loads and reactions leave {whole:.1e} of the largest force")
    for name in summary["sizes"]["interfaces"]:
        a, b = subdomains_of(scene, name)
        if name not in interfaces or len(a) != 1 or len(b) != 1:
            return whole, None  # not stored, or of several subdomains at one side
        force = resultant(interfaces[name], scene.get("thickness", 1.0))
        forces[a[0]].append(force)
        forces[b[0]].append(-force)
    errors = {subdomain: error(parts) for subdomain, parts in forces.items()}
    for subdomain, rest in errors.items():
        faults.expect(
            rest <= allowed,
            f"{results}: loads, reactions and interface tractions on {subdomain}"
            f" leave {rest:.1e} of the largest force",
        )
    return whole, max(errors.values())

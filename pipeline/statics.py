"""Do forces balance: loads, reactions and the tractions of the interfaces, integrated from the VTUs."""

import numpy as np

BALANCE = 1e-10  # of the largest force; where the solution is iterated, no better than its own residual


def resultant(grid, thickness):
    """Force of side B on side A: the tractions summed over the law points."""
    normal = grid["normal"][:, :2]
    tangent = np.column_stack([normal[:, 1], -normal[:, 0]])
    traction = grid["traction"][:, :1] * normal + grid["traction"][:, 1:] * tangent
    return thickness * grid["length"] @ traction


def sides(interface):
    """Subdomains of side A and of side B, as the scene names them."""
    names = []
    for side in ("side_a", "side_b"):
        groups = interface.get(side, [])
        groups = [groups] if isinstance(groups, str) else groups
        names.append({group.partition(".")[0] for group in groups})
    return names


def check_balance(results, scene, equilibrium, interfaces, residual, faults):
    """Forces on the whole model and on each subdomain sum to zero. Returns the largest error of either."""
    allowed = max(BALANCE, residual)
    forces = {name: [own["load"], own["reaction"]] for name, own in equilibrium["subdomains"].items()}
    size = np.abs(list(forces.values())).max(initial=np.finfo(float).tiny)

    def error(parts):
        return np.abs(np.sum(parts, axis=0)).max() / size

    whole = error([equilibrium["load"], equilibrium["reaction"]])
    faults.expect(whole <= allowed, f"{results}: loads and reactions leave {whole:.1e} of the largest force")
    for name, interface in scene.get("interfaces", {}).items():
        a, b = sides(interface)
        if name not in interfaces or len(a) != 1 or len(b) != 1:
            return whole, None  # not stored, or of several subdomains at one side
        force = resultant(interfaces[name], scene.get("thickness", 1.0))
        forces[a.pop()].append(force)
        forces[b.pop()].append(-force)
    errors = {subdomain: error(parts) for subdomain, parts in forces.items()}
    for subdomain, rest in errors.items():
        faults.expect(
            rest <= allowed,
            f"{results}: loads, reactions and interface tractions on {subdomain}"
            f" leave {rest:.1e} of the largest force",
        )
    return whole, max(errors.values())

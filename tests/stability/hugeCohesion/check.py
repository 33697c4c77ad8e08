"""Mohr-Coulomb soil with a cohesion of 1e9 Pa.
Hard: strengths a thousand times the stiffness enter differences of principal stresses; the law must switch itself off.
Pass: bitwise what linear elasticity gives, and nothing yields."""
from hardCase import HardCase

case = HardCase(__file__, __doc__)
file = "constant/materialProperties"
for shape in ("uGIMP", "cpGIMP"):
    for update in ("MUSL", "USL", "USF") if shape == "uGIMP" else ("MUSL",):
        strong = case.solve(f"{shape}{update}", ("system/mpmSchemes", "shape", shape), ("system/mpmSchemes", "stressUpdate", update))
        case.common(strong)
        elastic = case.seed(f"{shape}{update}elastic", ("system/mpmSchemes", "shape", shape), ("system/mpmSchemes", "stressUpdate", update))
        path = elastic.folder / file
        path.write_text(path.read_text().replace("mohrCoulomb", "linearElastic").replace("cohesion", "// ")
                        .replace("frictionAngle", "// ").replace("dilationAngle", "// "))
        elastic.utility("mpmSolve")
        case.check(f"exit code ({elastic.folder.name})", elastic.exit, "==", 0)
        a, b = strong.state(), elastic.state()
        tag = f"({shape}, {update})"
        case.check(f"numbers that differ {tag}", sum(int((a[n] != b[n]).sum()) for n in a.particles), "==", 0)
        case.check(f"plastic dissipation {tag}", abs(float(a.ledger["plasticDissipation"])), "==", 0, "J/m")
        history, other = strong.series(), elastic.series()
        case.check(f"rows of history that differ {tag}", sum(int((history[n] != other[n]).sum()) for n in history.dtype.names), "==", 0)
        case.check(f"strain energy at its peak {tag}", history["strainEnergy"].max(), ">", 100, "J/m")
case.finish()

"""Random scenes: one integer makes one scene, always the same."""

import math
import random


def wave_speed(E, nu, density):
    return math.sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / density)


class RandomScene:
    """Bodies, materials, walls, schemes and speeds drawn from one seed. All lengths are in cells of size h."""

    def __init__(self, seed):
        draw = random.Random(seed)
        self.seed = seed
        self.dim = 3 if draw.random() < 0.12 else 2
        self.h = 10 ** draw.uniform(-2, 1)
        self.per_cell = draw.choice([1, 2, 2, 3]) if self.dim == 2 else 2
        self.shape = draw.choice(["linear", "uGIMP", "cpGIMP", "quadraticBSpline"])
        self.update = draw.choice(["MUSL", "MUSL", "USF", "USL"])
        self.pic = draw.choice([0, 0, 2.0])
        self.materials = [self.material(draw) for _ in range(draw.choice([1, 1, 2]))]
        self.speed = max(wave_speed(m["E"], m["nu"], m["density"]) for m in self.materials)
        self.mach = draw.choice([0, 10 ** draw.uniform(-4, -1), 10 ** draw.uniform(-1, math.log10(2))])
        self.bodies = self.place(draw)
        self.box = (16, 12, 8)
        gravity = 10 ** draw.uniform(-6, -3)  # g h/c^2
        self.gravity = (gravity if self.mach == 0 or draw.random() < 0.5 else 0) * self.speed**2 / self.h
        self.walls = [(axis, side, self.wall(draw)) for axis in range(self.dim) for side in (-1, 1)]
        self.split = draw.random() < 0.25
        self.adjusts = draw.random() < 0.4
        self.factor = 10 ** draw.uniform(math.log10(0.1), math.log10(3))
        self.crossings = draw.uniform(2, 8)  # run time: cells a wave crosses, over 10

    def material(self, draw):
        density = 10 ** draw.uniform(2, 3.9)
        E = density * 10 ** draw.uniform(1, 7)
        m = {"law": draw.choice(["linearElastic", "mohrCoulomb"]), "density": density, "E": E,
             "nu": draw.choice([0, -0.2, 0.3, 0.42, 0.49, 0.499])}
        if m["law"] == "mohrCoulomb":
            m["frictionAngle"] = draw.choice([0, 20, 35, 42])
            m["dilationAngle"] = draw.choice([0, 0, 0.3 * m["frictionAngle"]])
            m["cohesion"] = E * draw.choice([1e-6, 1e-4, 1e-2] + ([0] if m["frictionAngle"] else []))
        return m

    def place(self, draw):
        """Boxes that do not overlap: (low, high) in cells, side by side along x."""
        bodies, start = [], draw.uniform(1.5, 3)
        for k in range(draw.choice([1, 2]) if len(self.materials) == 1 else 2):
            size = [draw.choice([2, 3, 4])] + [draw.choice([2, 4]) for _ in range(self.dim - 1)]
            low = [start] + [draw.choice([0, draw.uniform(0.2, 2)]) + 1 for _ in range(self.dim - 1)]
            high = [a + b for a, b in zip(low, size)]
            direction = [draw.uniform(-1, 1) for _ in range(self.dim)]
            norm = math.sqrt(sum(d * d for d in direction)) or 1
            velocity = [self.mach * self.speed * d / norm for d in direction]
            bodies.append((low, high, k % len(self.materials), velocity))
            start = high[0] + draw.choice([0.1, 0.7, 1.6])
        return bodies

    @staticmethod
    def wall(draw):
        """Kind, friction, separation. Walls on all sides: a body that leaves the grid would only end the run."""
        return draw.choice(["fixed", "roller", "friction", "friction"]), draw.choice([0, 0.3, 1e6]), draw.choice(["on", "off"])

    # the case folder

    def describe(self):
        laws = "+".join(m["law"] for m in self.materials)
        return (f"{self.dim}D {self.shape} {self.update} {laws} Mach {self.mach:.2g}"
                f"{' gravity' if self.gravity else ''}{' splitting' if self.split else ''}")

    def write(self, folder, delta_t, end_time, adjust):
        for part in ("geometry", "constant", "system"):
            (folder / part).mkdir(parents=True, exist_ok=True)
        (folder / "geometry" / "bodies.geo").write_text(self.geometry())
        (folder / "constant" / "materialProperties").write_text("".join(
            f"body{k}\n{{\n" + "".join(f"    {word} {value};\n" for word, value in self.materials[body[2]].items()) +
            f"    initialVelocity ({' '.join(f'{v:.17g}' for v in body[3] + [0] * (3 - self.dim))});\n}}\n"
            for k, body in enumerate(self.bodies)))
        if self.gravity:
            down = f"(0 {-self.gravity:.17g} 0)"
            (folder / "constant" / "g").write_text(f"dimensions [0 1 -2 0 0 0 0];\nvalue {down};\n")
        (folder / "constant" / "boundaryConditions").write_text("".join(self.boundary(*w) for w in self.walls))
        top = [self.h * self.box[a] if a < self.dim else 0 for a in range(3)]
        (folder / "system" / "gridDict").write_text(
            f"dimension {self.dim};\nmin (0 0 0);\nmax ({' '.join(f'{x:.17g}' for x in top)});\n"
            f"cellSize {self.h:.17g};\n")
        (folder / "system" / "seedParticlesDict").write_text(f"particlesPerCell {self.per_cell};\n")
        split = "splitting { threshold 2.2; mode fourWay; maxGeneration 2; interval 5; }\n" if self.split else ""
        (folder / "system" / "mpmSchemes").write_text(
            f"shape {self.shape};\nstressUpdate {self.update};\ntransfer FLIP;\npicRate {self.pic};\n{split}")
        (folder / "system" / "controlDict").write_text(
            f"startFrom latestTime;\nendTime {end_time:.17g};\ndeltaT {delta_t:.17g};\n"
            f"adjustTimeStep {'yes' if adjust else 'no'};\nmaxCo 0.5;\n"
            f"writeControl runTime;\nwriteInterval {end_time / 4:.17g};\ntimePrecision 12;\nhistoryInterval 1;\n")

    def geometry(self):
        lines = ['SetFactory("OpenCASCADE");']
        for k, (low, high, _, _) in enumerate(self.bodies):
            low, size = [self.h * a for a in low], [self.h * (b - a) for a, b in zip(low, high)]
            if self.dim == 2:
                lines.append(f"Rectangle({k + 1}) = {{{low[0]:.17g}, {low[1]:.17g}, 0, {size[0]:.17g}, {size[1]:.17g}}};")
            else:
                lines.append(f"Box({k + 1}) = {{{', '.join(f'{v:.17g}' for v in low + size)}}};")
            lines.append(f'Physical {"Surface" if self.dim == 2 else "Volume"}("body{k}") = {{{k + 1}}};')
        return "\n".join(lines) + "\n"

    def boundary(self, axis, side, kind):
        normal = ["0", "0", "0"]
        normal[axis] = str(side)
        position = self.h * (1 if side < 0 else self.box[axis] - 1)
        mu = f" mu {kind[1]};" if kind[0] == "friction" else ""
        return (f"wall{'xyz'[axis]}{'Low' if side < 0 else 'High'} {{ type {kind[0]};{mu} separation {kind[2]}; "
                f"plane {{ normal ({' '.join(normal)}); position {position:.17g}; }} }}\n")

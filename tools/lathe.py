"""Meshes turned on a lathe, as PLY files: for the tools that make the meshes of scenes/."""
import math
import struct


def write_ply(path, vertices, quads):
    """vertices: (x, y, z, nx, ny, nz), or with (s, t) behind; quads: corners counter-clockwise seen
    from the front."""
    names = ("x", "y", "z", "nx", "ny", "nz", "s", "t")[:len(vertices[0])]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(quads)}", "property list uchar ushort vertex_indices", "end_header"]
    with open(path, "wb") as file:
        file.write(("\n".join(header) + "\n").encode())
        for vertex in vertices:
            file.write(struct.pack(f"<{len(names)}f", *vertex))
        for quad in quads:
            corners = list(dict.fromkeys(quad))
            file.write(struct.pack(f"<B{len(corners)}H", len(corners), *corners))


def smooth(points, steps=4):
    """A Catmull-Rom curve through the points, `steps` pieces from each to the next."""
    curve = []
    padded = [points[0], *points, points[-1]]
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
        for i in range(steps):
            t = i / steps
            curve.append(tuple(
                0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t
                       + (3 * q - p - 3 * r + s) * t ** 3)
                for p, q, r, s in zip(a, b, c, d)))
    return curve + [points[-1]]


def turn(curves, around):
    """Turns curves of (radius, height) around z. The solid lies to the left of each curve, and
    normals are smooth along it, so that a crease is where one curve ends and the next begins."""
    vertices, quads = [], []
    for curve in curves:
        first = len(vertices)
        rows = len(curve)
        for i, (r, z) in enumerate(curve):
            (r0, z0), (r1, z1) = curve[max(i - 1, 0)], curve[min(i + 1, rows - 1)]
            nr, nz = z1 - z0, r0 - r1
            if r < 1e-9:
                nr = 0
            length = math.hypot(nr, nz)
            for k in range(around):
                c, s = math.cos(2 * math.pi * k / around), math.sin(2 * math.pi * k / around)
                vertices.append((r * c, r * s, z, nr / length * c, nr / length * s, nz / length))
        for i in range(rows - 1):
            for k in range(around):
                a, b = first + i * around + k, first + i * around + (k + 1) % around
                c, d = b + around, a + around
                if curve[i][0] < 1e-9:
                    b = a
                if curve[i + 1][0] < 1e-9:
                    c = d
                quads.append((a, b, c, d))
    return vertices, quads

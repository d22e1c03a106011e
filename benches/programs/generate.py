"""Large programs and libraries for the figures of docs/performance.md. Standard library only; the same bytes every time.

    python3 benches/programs/generate.py program rapid 1000000 big.mod
    python3 benches/programs/generate.py program krl 1000000 big.src
    python3 benches/programs/generate.py program csv 1000000 big.csv
    python3 benches/programs/generate.py program gcode 1000000 big.nc
    python3 benches/programs/generate.py library lib

A program is a raster over a slightly curved plate in front of an ABB IRB 6640, the tool pointing down and leaning with
the surface. A library is 500 RAPID modules of 100 inline targets, 500 of 100 declared ones and 500 KRL jobs (`.src` and
`.dat`) of 200 in 50 folders: 2,000 files, 200,000 targets. Programs that name tools and frames define them; those of CSV
and G-code stand in `cell.yaml` beside the program.
"""

import math
import pathlib
import sys

A_LINE = 200
CELL = """schema: falsetarget/cell/1
tools:  {"mill": {xyz_mm: [0, 0, 250], rpy_deg: [0, 0, 0], payload: {mass_kg: 80, com_mm: [0, 0, 120]}}}
frames: {"plate": {xyz_mm: [1500, 0, 900], rpy_deg: [0, 0, 0]}}
"""


def points(count, seed=0):
    """Positions, mm, and the two leans of the tool, rad, along a raster of `count` points."""
    lines = max(1.0, count / A_LINE)
    for index in range(count):
        line, along = divmod(index, A_LINE)
        along = along if line % 2 == 0 else A_LINE - 1 - along
        x = 400.0 * line / lines + seed % 97
        y = 800.0 * (along / A_LINE - 0.5) + seed % 89
        z = 100.0 * math.cos(0.003 * y)
        yield x, y, z, math.pi + 0.0003 * y, 0.1 + 0.0002 * x


def quaternion(about_x, about_y):
    """Rx(about_x) Ry(about_y) as w, x, y, z."""
    (ca, sa), (cb, sb) = [(math.cos(angle / 2), math.sin(angle / 2)) for angle in (about_x, about_y)]
    return ca * cb, sa * cb, ca * sb, sa * sb


def fixed_xyz(about_x, about_y):
    """The same rotation as roll, pitch, yaw in degrees: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    (ca, sa), (cb, sb) = [(math.cos(angle), math.sin(angle)) for angle in (about_x, about_y)]
    # Rx(a) Ry(b), the elements that the angles need.
    r00, r10, r20, r21, r22 = cb, sa * sb, -ca * sb, sa, ca * cb
    return [math.degrees(angle) for angle in (math.atan2(r21, r22), math.atan2(-r20, math.hypot(r00, r10)), math.atan2(r10, r00))]


def robtarget(point):
    x, y, z, about_x, about_y = point
    w, i, j, k = quaternion(about_x, about_y)
    quadrant = 0 if y >= 0 else -1
    return (
        f"[[{x:.3f},{y:.3f},{z:.3f}],[{w:.8f},{i:.8f},{j:.8f},{k:.8f}],[{quadrant},0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]]"
    )


def rapid(name, all_points, declared=False):
    yield f"MODULE {name}\n"
    yield "  PERS tooldata tMill:=[TRUE,[[0,0,250],[1,0,0,0]],[80,[0,0,120],[1,0,0,0],0,0,0]];\n"
    yield '  PERS wobjdata wPlate:=[FALSE,TRUE,"",[[1500,0,900],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
    if declared:
        all_points = list(all_points)
        for index, point in enumerate(all_points):
            yield f"  LOCAL CONST robtarget p{index}:={robtarget(point)};\n"
    yield f"  PROC {name}_run()\n"
    for index, point in enumerate(all_points):
        target = f"p{index}" if declared else robtarget(point)
        yield f"    MoveL {target},v100,z1,tMill\\WObj:=wPlate;\n"
    yield "  ENDPROC\nENDMODULE\n"


def krl_frame(point):
    x, y, z, about_x, about_y = point
    roll, pitch, yaw = fixed_xyz(about_x, about_y)
    return f"{{X {x:.3f},Y {y:.3f},Z {z:.3f},A {yaw:.5f},B {pitch:.5f},C {roll:.5f}}}"


KRL_HEAD = (
    "$TOOL={X 0.0,Y 0.0,Z 250.0,A 0.0,B 0.0,C 0.0}\n"
    "$BASE={X 1500.0,Y 0.0,Z 900.0,A 0.0,B 0.0,C 0.0}\n"
    "$LOAD={M 80.0,CM {X 0.0,Y 0.0,Z 120.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}\n"
)


def krl(name, all_points):
    yield f"&ACCESS RVO\nDEF {name}()\n{KRL_HEAD}"
    for point in all_points:
        yield f"LIN {krl_frame(point)} C_DIS\n"
    yield "END\n"


def krl_with_data(name, all_points):
    all_points = list(all_points)
    source = f"&ACCESS RVO\nDEF {name}()\n{KRL_HEAD}"
    source += "".join(f"LIN XP{index} C_DIS\n" for index in range(len(all_points))) + "END\n"
    data = f"&ACCESS RVO\nDEFDAT {name} PUBLIC\n"
    data += "".join(f"DECL FRAME XP{index}={krl_frame(point)}\n" for index, point in enumerate(all_points)) + "ENDDAT\n"
    return source, data


def csv(_, all_points):
    yield "name,x_mm,y_mm,z_mm,qw,qx,qy,qz,tool,frame,motion\n"
    for index, (x, y, z, about_x, about_y) in enumerate(all_points):
        turn = ",".join(f"{number:.8f}" for number in quaternion(about_x, about_y))
        yield f"P{index},{x:.3f},{y:.3f},{z:.3f},{turn},mill,plate,MoveL\n"


def gcode(_, all_points):
    yield "%\nO0001 (PLATE)\n(FALSETARGET: ORIENTATION=FIXED-XYZ UNITS=MM,DEG FRAME=PLATE TOOL=MILL)\nG21 G90\nG1 F6000.\n"
    for x, y, z, about_x, about_y in all_points:
        roll, pitch, yaw = fixed_xyz(about_x, about_y)
        yield f"X{x:.3f} Y{y:.3f} Z{z:.3f} A{roll:.4f} B{pitch:.4f} C{yaw:.4f}\n"
    yield "M30\n%\n"


LANGUAGES = {"rapid": rapid, "krl": krl, "csv": csv, "gcode": gcode}


def write(path, pieces):
    with open(path, "w", encoding="ascii", newline="") as file:
        file.writelines(pieces)


def library(folder):
    for index in range(500):
        place = folder / f"line{index % 50:02}"
        place.mkdir(parents=True, exist_ok=True)
        write(place / f"inline{index:03}.mod", rapid(f"inline{index:03}", points(100, seed=index)))
        write(place / f"named{index:03}.mod", rapid(f"named{index:03}", points(100, seed=index + 500), declared=True))
        source, data = krl_with_data(f"job{index:03}", points(200, seed=index + 1000))
        write(place / f"job{index:03}.src", source)
        write(place / f"job{index:03}.dat", data)


def main(arguments):
    match arguments:
        case ["program", language, count, path] if language in LANGUAGES:
            path = pathlib.Path(path)
            write(path, LANGUAGES[language]("big", points(int(count))))
            if language in ("csv", "gcode"):
                (path.parent / "cell.yaml").write_text(CELL, encoding="ascii")
        case ["library", folder]:
            library(pathlib.Path(folder))
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])

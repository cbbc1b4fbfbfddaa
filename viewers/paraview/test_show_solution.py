"""Tries show_solution.py in ParaView itself, on a solution that the program bakes.

    test_show_solution.py PROGRAM SCENE FOLDER

Without ParaView's Python or an X server that can be started it is skipped: exit code 77.
"""

import importlib.util
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
SCRIPT = pathlib.Path(__file__).with_name('show_solution.py')


def run(*words, ok=True):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if ok and done.returncode != 0:
        sys.exit('%s: exit code %d\n%s' % (words, done.returncode, done.stderr))
    return done


def show(*words, ok=True):
    return run('xvfb-run', '-a', '-s', '-screen 0 1280x1024x24', sys.executable, SCRIPT, *words, ok=ok)


def mean_colour(picture, across, down):
    """About a place of a picture, in shares of its size."""
    from paraview.vtk.vtkIOImage import vtkPNGReader
    reader = vtkPNGReader()
    reader.SetFileName(str(picture))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    x, y = int(across * width), int((1 - down) * height)
    pixels = [[image.GetScalarComponentAsDouble(x + i, y + j, 0, c) for c in range(3)]
              for i in range(-2, 3) for j in range(-2, 3)]
    return [sum(p[c] for p in pixels) / len(pixels) for c in range(3)]


def expect(is_so, what):
    if not is_so:
        sys.exit('wrong: ' + what)


def main(program, scene, folder):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    box = folder / 'box.vtm'
    run(program, '-q', 'bake', scene, '-o', box, '--leaves', 1000, '--iterations', 32,
        '--refine', 2, '--phases')

    picture = folder / 'picture.png'
    show(box, picture, '--camera', 'front', '--size', '500x500')
    left, right = mean_colour(picture, 0.25, 0.5), mean_colour(picture, 0.75, 0.5)
    expect(left[0] > 2 * left[1] and left[0] > 2 * left[2], 'the left wall is red: %s' % left)
    expect(right[1] > 1.2 * right[0] and right[1] > 2 * right[2], 'the right wall is green: %s' % right)
    show(box, folder / 'corner.png', '--camera', 'corner', '--size', '500x500')
    expect((folder / 'corner.png').read_bytes() != picture.read_bytes(), 'cameras differ')

    phases = [folder / ('phase-%d.png' % phase) for phase in (0, 1)]
    for phase, level in enumerate(phases):
        show(folder / 'box-phases.pvd', level, '--phase', phase, '--array', 'Level')
    expect(phases[0].read_bytes() != phases[1].read_bytes(), 'phases differ')
    state = folder / 'box.pvsm'
    show(box, folder / 'error.png', '--array', 'StandardError', '--state', state)
    expect('StandardError' in state.read_text(), 'the state holds the array')

    (folder / 'other.vtm').write_text('<VTKFile type="vtkMultiBlockDataSet"><vtkMultiBlockDataSet/></VTKFile>')
    for words, named in [((folder / 'other.vtm',), 'not a solution'), ((box, '--array', 'Colour'), 'StandardError'),
                         ((box, '--camera', 'top'), 'corner')]:
        failed = show(*words, ok=False)
        expect(failed.returncode != 0 and named in failed.stderr, '%s: %s' % (words, failed.stderr))


if importlib.util.find_spec('paraview') is None or shutil.which('xvfb-run') is None:
    print("skipped: ParaView's Python (PYTHONPATH) or xvfb-run is missing")
    sys.exit(SKIPPED)
main(*sys.argv[1:])

"""Tries transillum-view in a real window under Xvfb: pictures, keys, mistakes.

    test_view.py VIEWER PROGRAM SCENE FOLDER
"""

import json
import os
import pathlib
import select
import shutil
import subprocess
import sys
import time

SKIPPED = 77
EXPOSURE = ('--no-auto-exposure', '--exposure', 1.5)


def run(*words, ok=True, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    if ok and done.returncode != 0:
        sys.exit('%s: exit code %d\n%s' % (words, done.returncode, done.stderr))
    return done


def expect(is_so, what):
    if not is_so:
        raise AssertionError(what)


class Screen:
    """An X server of its own."""

    def __enter__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ['Xvfb', '-displayfd', str(write), '-screen', '0', '1280x1024x24', '-nolisten', 'tcp',
             '-noreset'],  # when a client leaves: others could not connect then
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.environment = dict(os.environ, DISPLAY=':' + number.readline().strip())
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


class Window:
    """A viewer that is used by keys and mouse."""

    def __init__(self, screen, viewer, *words):
        self.environment = screen.environment
        self.viewer = subprocess.Popen([str(w) for w in (viewer, *words)], env=self.environment,
                                       stdout=subprocess.PIPE, text=True)
        deadline = time.time() + 60
        while not self.find():
            expect(time.time() < deadline and self.viewer.poll() is None, 'a window opens')
            time.sleep(0.1)
        time.sleep(1)
        self.do('mousemove', '250', '250')  # without a window manager, keys go where the pointer is

    def find(self):
        return run('xdotool', 'search', '--name', '^transillum', ok=False,
                   env=self.environment).stdout.split()

    def do(self, *words):
        run('xdotool', *words, env=self.environment)
        time.sleep(0.3)

    def picture(self):
        """What F2 writes."""
        self.do('key', 'F2')
        ready, _, _ = select.select([self.viewer.stdout], [], [], 30)
        expect(ready, 'F2 writes a picture')
        return pathlib.Path(self.viewer.stdout.readline().strip()).read_bytes()

    def picture_to(self, path):
        path.write_bytes(self.picture())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.viewer.kill()

    def close(self):
        self.do('key', 'Escape')
        return self.viewer.wait(timeout=30)


def use(window):
    """By keys and mouse."""
    before = window.picture()
    expect(window.picture() == before, 'nothing moves by itself')
    pictures = [before]

    def changes(what, *words):
        window.do(*words)
        pictures.append(window.picture())
        expect(pictures[-1] != pictures[-2], what + ' changes the picture')

    changes('exposure', 'key', 'bracketright')
    window.do('key', 'bracketleft')
    expect(window.picture() == before, 'exposure comes back')
    changes('the help', 'key', 'h')
    changes('a quantity', 'key', '8')
    changes('edges', 'key', 'x')
    changes('a picked patch', 'mousemove', '250', '300', 'key', 'p')
    changes('walking', 'keydown', 'w', 'sleep', '0.5', 'keyup', 'w')
    changes('looking', 'mousemove', '250', '250', 'mousedown', '1', 'mousemove', '300', '260', 'mouseup', '1')
    window.do('key', 'b')
    changes('the next camera', 'key', 'c')
    window.do('key', 'c')
    expect(window.picture() == pictures[-2], 'a bookmark comes back')
    expect(window.close() == 0, 'Escape ends it')


def stand_still(window, folder, program):
    """The iteration goes on, sharpens the picture, and is left at once for a view that moves."""
    exact = folder / 'exact.png'
    run(program, '-q', 'render', folder / 'box.vtm', '-o', exact, '--camera', 'front', '--size', '500x500', *EXPOSURE)

    def difference(name):
        window.picture_to(folder / name)
        found = run(program, '-q', 'compare', folder / name, exact, '--json', ok=False).stdout
        return json.loads(found)['relative_rmse']

    window.do('key', 't')
    window.do('key', 'i')  # stored colours
    stored = difference('stored.png')
    window.do('key', 'i')
    deadline = time.time() + 120
    while (still := difference('still.png')) > 0.6 * stored:
        expect(time.time() < deadline, 'standing still sharpens: %g after %g' % (still, stored))
        time.sleep(1)
    window.do('mousemove', '250', '250', 'mousedown', '1', 'mousemove', '290', '250', 'mouseup', '1')
    moved = window.picture()
    expect(moved != (folder / 'still.png').read_bytes(), 'a moved view shows something else')
    deadline = time.time() + 120
    while window.picture() == moved:
        expect(time.time() < deadline, 'the new view is sharpened, too')
        time.sleep(1)
    expect(window.close() == 0, 'Escape ends it')


def main(viewer, program, scene, folder):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    box = folder / 'box.vtm'
    run(program, '-q', 'bake', scene, '-o', box, '--leaves', 2000, '--iterations', 64, '--refine', 1)
    rendered = folder / 'rendered.png'
    run(program, '-q', 'render', box, '-o', rendered, '--camera', 'front', '--size', '500x500',
        '--direct', 'stored', *EXPOSURE)
    at_front = (box, '--camera', 'front', '--width', 500, '--height', 500, *EXPOSURE)
    with Screen() as screen:
        def shot(name, *words):
            run(viewer, *words, '--screenshot', folder / name, env=screen.environment)
            return folder / name

        # Edges are sharp in the window and blended in the picture.
        seen = shot('seen.png', *at_front)
        run(program, 'compare', seen, rendered, '--fail-above', 0.1)
        corner = shot('corner.png', *at_front[:1], '--camera', 'corner', *at_front[3:])
        expect(run(program, 'compare', corner, rendered, '--fail-above', 0.3, ok=False).returncode == 1,
               'another camera shows something else')

        with Window(screen, viewer, *at_front, '--no-iteration') as window:
            use(window)
        with Window(screen, viewer, *at_front) as window:
            stand_still(window, folder, program)

        for words, code, named in [((folder / 'none.vtm',), 4, 'none.vtm'), ((box, '--camera', 'top'), 2, 'front'),
                                   ((box, '--quantity', 10), 2, '1 to '), ((rendered,), 3, 'rendered.png')]:
            failed = run(viewer, *words, ok=False, env=screen.environment)
            expect(failed.returncode == code and named in failed.stderr, (words, failed.returncode, failed.stderr))
    blind = {name: value for name, value in os.environ.items() if name != 'DISPLAY'}
    for environment in (blind, dict(blind, DISPLAY=':4711')):
        failed = run(viewer, box, ok=False, env=environment)
        expect(failed.returncode == 4 and 'DISPLAY' in failed.stderr, failed.stderr)


if shutil.which('Xvfb') is None or shutil.which('xdotool') is None:
    print('skipped: Xvfb or xdotool is missing')
    sys.exit(SKIPPED)
main(*sys.argv[1:])

"""Shows a baked solution in ParaView: its radiance as a picture, or another array by a colour map.

As a macro: it takes the solution (.vtm) or the phases (.pvd) selected in the pipeline browser.
From a shell, with ParaView's Python:

    pvpython show_solution.py room.vtm picture.png
    pvpython show_solution.py room.vtm error.png --array StandardError
    pvpython show_solution.py room-phases.pvd phase.png --phase 2 --array Level
    pvpython show_solution.py room.vtm --state room.pvsm      # for File > Load State
"""

import argparse
import sys

from paraview import servermanager
from paraview.simple import (
    Calculator, ColorBy, ExtractBlock, GetActiveSource, GetActiveViewOrCreate,
    GetColorTransferFunction, GetScalarBar, GetTimeKeeper, Hide, OpenDataFile, Render, ResetCamera,
    SaveScreenshot, SaveState, Show)

DECADES = 3          # of luminance that the colour map spans
MEAN_SHOWN_AS = 0.4  # grey level of the middle of the luminance range, before gamma
UNITS = {
    'StandardError': 'W sr^-1 m^-2', 'DirectIrradiance': 'W m^-2', 'IndirectIrradiance': 'W m^-2',
    'DirectRadiance': 'W sr^-1 m^-2', 'FiniteElementRadiance': 'W sr^-1 m^-2',
    'Emission': 'W sr^-1 m^-2', 'ErrorSpatial': 'W^2 sr^-2 m^-4',
    'ErrorDirectional': 'W^2 sr^-2 m^-4'}


def luminance_of(source, array):
    luminance = Calculator(Input=source, AttributeType='Cell Data', ResultArrayName='Luminance')
    luminance.Function = '0.2126*{0}_X + 0.7152*{0}_Y + 0.0722*{0}_Z'.format(array)
    return luminance


def tone_map(source, exposure):
    """Reinhard's curve per channel, then gamma 2.2."""
    channel = '((%g*Radiance_{0})/(1+%g*Radiance_{0}))^(1/2.2)' % (exposure, exposure)
    parts = zip((channel.format(axis) for axis in 'XYZ'), ('iHat', 'jHat', 'kHat'))
    shown = Calculator(Input=source, AttributeType='Cell Data', ResultArrayName='Shown')
    shown.Function = ' + '.join('%s*%s' % part for part in parts)
    return shown


def show_unlit(source, view):
    display = Show(source, view)
    display.BackfaceRepresentation = 'Cull Backface'  # the other side has cells of its own
    display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0  # the light is baked: add none
    return display


def show_picture(radiance, view):
    luminance = luminance_of(radiance, 'Radiance')
    luminance.UpdatePipeline()
    brightest = luminance.CellData['Luminance'].GetRange()[1]
    if brightest <= 0:
        raise RuntimeError('no light in this solution')
    typical = brightest * 10 ** (-DECADES / 2)
    shown = tone_map(luminance, MEAN_SHOWN_AS / (1 - MEAN_SHOWN_AS) / typical)
    display = show_unlit(shown, view)
    ColorBy(display, ('CELLS', 'Shown'))
    display.MapScalars = 0

    # For whoever colours by luminance instead.
    colours = GetColorTransferFunction('Luminance')
    colours.RescaleTransferFunction(brightest * 10 ** -DECADES, brightest)
    colours.MapControlPointsToLogSpace()
    colours.UseLogScale = 1


def leaf_of_composite(data):
    """The one dataset in a tree of blocks, or None."""
    while data is not None and data.IsA('vtkMultiBlockDataSet'):
        blocks = (data.GetBlock(i) for i in range(data.GetNumberOfBlocks()))
        data = next((block for block in blocks if block is not None), None)
    return data


def range_without_outliers(source, array):
    """Of which a few would leave no colours to the rest."""
    values = leaf_of_composite(servermanager.Fetch(source)).GetCellData().GetArray(array)
    ordered = sorted(values.GetValue(i) for i in range(values.GetNumberOfValues()))
    last = len(ordered) - 1
    return ordered[round(0.005 * last)], ordered[round(0.995 * last)]


def show_array(source, view, array):
    """By a colour map with a bar; of three channels, the luminance."""
    found = source.CellData[array]
    if found is None:
        raise RuntimeError('no array %s; there are: %s' % (array, ', '.join(source.CellData.keys())))
    shown = source
    if found.GetNumberOfComponents() == 3:
        shown, array_shown = luminance_of(source, array), 'Luminance'
    else:
        array_shown = array
    display = show_unlit(shown, view)
    ColorBy(display, ('CELLS', array_shown))
    colours = GetColorTransferFunction(array_shown)
    colours.RescaleTransferFunction(*range_without_outliers(shown, array_shown))
    bar = GetScalarBar(colours, view)
    bar.Title = array
    bar.ComponentTitle = UNITS.get(array, '')
    display.SetScalarBarVisibility(view, True)


def look(reader, view, name):
    """From a camera of the solution: the named one, else the first; at all of it if there is none."""
    surface = ExtractBlock(Input=reader, Selectors=['/Root/surface'])
    data = leaf_of_composite(servermanager.Fetch(surface))
    fields = data.GetFieldData() if data is not None else None
    names = fields.GetAbstractArray('CameraName') if fields else None
    count = names.GetNumberOfValues() if names else 0
    cameras = {names.GetValue(i): i for i in range(count)}
    if name is not None and name not in cameras:
        raise RuntimeError('no camera %s; there are: %s' % (name, ', '.join(cameras) or 'none'))
    if not cameras:
        ResetCamera(view)
        return
    i = cameras[name] if name is not None else 0
    view.CameraPosition = fields.GetArray('CameraEye').GetTuple3(i)
    view.CameraFocalPoint = fields.GetArray('CameraLookAt').GetTuple3(i)
    view.CameraViewUp = fields.GetArray('CameraUp').GetTuple3(i)
    view.CameraViewAngle = fields.GetArray('CameraVerticalFov').GetValue(i)


def show(reader, array=None, camera=None, phase=None):
    view = GetActiveViewOrCreate('RenderView')
    times = list(getattr(reader, 'TimestepValues', None) or [])
    if phase is not None and phase not in times:
        raise RuntimeError('no phase %g; there are: %s' % (phase, ', '.join('%g' % t for t in times)))
    if times:
        GetTimeKeeper().Time = times[-1] if phase is None else phase
        view.ViewTime = GetTimeKeeper().Time
    reader.UpdatePipeline(view.ViewTime if times else 0)
    radiance = ExtractBlock(Input=reader, Selectors=['/Root/radiance'])
    radiance.UpdatePipeline(view.ViewTime if times else 0)
    if radiance.CellData['Radiance'] is None:
        raise RuntimeError('no block radiance with an array Radiance: not a solution of transillum')
    if array is None or array == 'Radiance':
        show_picture(radiance, view)
    else:
        show_array(radiance, view, array)
    Hide(reader, view)
    look(reader, view, camera)
    Render(view)
    return view


def main():
    if not any(word.endswith(('.vtm', '.pvd')) for word in sys.argv[1:]):
        if GetActiveSource() is None:
            raise RuntimeError('select a solution (.vtm, .pvd) in the pipeline browser first')
        show(GetActiveSource())
        return
    parser = argparse.ArgumentParser(description='Shows a baked solution.')
    parser.add_argument('solution', help='.vtm of bake, or .pvd of bake --phases')
    parser.add_argument('picture', nargs='?', help='.png to write')
    parser.add_argument('--array', help='cell array to colour by (default: Radiance, as a picture)')
    parser.add_argument('--camera', help='of the solution, by name (default: the first)')
    parser.add_argument('--phase', type=float, help='of a .pvd (default: the last)')
    parser.add_argument('--size', default='800x600', help='of the picture (default: %(default)s)')
    parser.add_argument('--state', help='.pvsm to write, for File > Load State')
    a = parser.parse_args()
    view = show(OpenDataFile(a.solution), a.array, a.camera, a.phase)
    if a.picture:
        size = [int(n) for n in a.size.split('x')]
        view.ViewSize = size
        SaveScreenshot(a.picture, view, ImageResolution=size)
    if a.state:
        SaveState(a.state)


main()

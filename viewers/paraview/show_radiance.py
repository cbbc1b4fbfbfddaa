"""Shows the radiance of a baked solution in ParaView.

As a macro: it takes the solution (.vtm) that is selected in the pipeline browser.
From a shell: pvpython show_radiance.py room.vtm picture.png
"""

import sys

from paraview.simple import (
    Calculator, ColorBy, ExtractBlock, GetActiveSource, GetActiveViewOrCreate,
    GetColorTransferFunction, Hide, Render, ResetCamera, SaveScreenshot, Show,
    XMLMultiBlockDataReader)

DECADES = 3          # of luminance that the colour map spans
MEAN_SHOWN_AS = 0.4  # grey level of the middle of the luminance range, before gamma


def luminance_of(radiance):
    luminance = Calculator(Input=radiance, AttributeType='Cell Data', ResultArrayName='Luminance')
    luminance.Function = '0.2126*Radiance_X + 0.7152*Radiance_Y + 0.0722*Radiance_Z'
    return luminance


def tone_map(source, exposure):
    """Reinhard's curve per channel, then gamma 2.2."""
    channel = '((%g*Radiance_{0})/(1+%g*Radiance_{0}))^(1/2.2)' % (exposure, exposure)
    parts = zip((channel.format(axis) for axis in 'XYZ'), ('iHat', 'jHat', 'kHat'))
    shown = Calculator(Input=source, AttributeType='Cell Data', ResultArrayName='Shown')
    shown.Function = ' + '.join('%s*%s' % part for part in parts)
    return shown


def show(reader, view):
    radiance = ExtractBlock(Input=reader, Selectors=['/Root/radiance'])
    luminance = luminance_of(radiance)
    luminance.UpdatePipeline()
    array = luminance.CellData['Luminance']
    if array is None or array.GetRange()[1] <= 0:
        raise RuntimeError('no light in this solution')
    brightest = array.GetRange()[1]
    typical = brightest * 10 ** (-DECADES / 2)

    shown = tone_map(luminance, MEAN_SHOWN_AS / (1 - MEAN_SHOWN_AS) / typical)
    Hide(reader, view)
    display = Show(shown, view)
    ColorBy(display, ('CELLS', 'Shown'))
    display.MapScalars = 0
    display.BackfaceRepresentation = 'Cull Backface'  # the other side has cells of its own
    display.Ambient, display.Diffuse = 1.0, 0.0  # the light is baked: add none

    # For whoever colours by luminance instead.
    colours = GetColorTransferFunction('Luminance')
    colours.RescaleTransferFunction(brightest * 10 ** -DECADES, brightest)
    colours.MapControlPointsToLogSpace()
    colours.UseLogScale = 1
    return shown


def main():
    view = GetActiveViewOrCreate('RenderView')
    from_shell = len(sys.argv) > 1 and sys.argv[1].endswith('.vtm')
    reader = XMLMultiBlockDataReader(FileName=[sys.argv[1]]) if from_shell else GetActiveSource()
    if reader is None:
        raise RuntimeError('select a solution (.vtm) in the pipeline browser first')
    show(reader, view)
    ResetCamera(view)
    Render(view)
    if from_shell and len(sys.argv) > 2:
        SaveScreenshot(sys.argv[2], view)


main()

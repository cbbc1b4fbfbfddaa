/// Whether a window can be opened.
#pragma once

namespace transillum::viewer {

/// \throws IoError where DISPLAY is not that of an X server that answers. VTK would crash.
void require_display();

}  // namespace transillum::viewer

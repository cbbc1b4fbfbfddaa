// Apart, as Xlib's macros take common words.
#include "require_display.h"

#include <transillum/base/error.h>

#include <X11/Xlib.h>

#include <cstdlib>
#include <string>

namespace transillum::viewer {

void require_display() {
    const char* const name = std::getenv("DISPLAY");
    Display* const display = XOpenDisplay(nullptr);
    if (!display)
        throw IoError("the window", std::string("cannot be opened: DISPLAY is ") +
                                        (name ? name : "not set") +
                                        "; accepted: that of an X server that answers");
    XCloseDisplay(display);
}

}  // namespace transillum::viewer

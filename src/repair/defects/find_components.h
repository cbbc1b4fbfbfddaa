/// Components as reports tell them.
#pragma once

#include "repair/defects/find_sheets.h"

#include <transillum/repair/check_scene.h>

namespace transillum {

/// One a sheet. Where its faces disagree, the volume is that of consistent ones turned outwards.
[[nodiscard]] std::vector<Component> find_components(const TriangleSoup& soup, const Scene& scene,
                                                     const EdgeTable& edges, const Sheets& sheets);

}  // namespace transillum

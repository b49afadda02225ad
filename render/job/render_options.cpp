#include "render/job/render_options.h"

namespace offstage {

Viewport RenderOptions::viewport(double paneWidth, double paneHeight, double sceneScale) const {
  if (size) return Viewport::fitted(paneWidth, paneHeight, (*size)[0], (*size)[1]);
  return Viewport::scaled(paneWidth, paneHeight, sceneScale);
}

} // namespace offstage

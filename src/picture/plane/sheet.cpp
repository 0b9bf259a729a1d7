// SPDX-License-Identifier: Apache-2.0
#include "plane/sheet.h"

#include "obvid/core/internal/picture_mark.h"
#include "obvid/core/internal/shown_text.h"
#include "plane/canvas.h"
#include "plane/panels.h"

namespace obvid {
namespace {

/// Colours told apart by colour-blind eyes too, one set for light and one for dark viewers.
/// Each colour stands in the light set first, so that viewers without CSS queries show that.
constexpr const char* kStyle = R"(<style>
text{font-family:"Helvetica Neue",Arial,"Liberation Sans","DejaVu Sans",sans-serif;fill:#1c2733}
.title{font-size:20px;font-weight:600}.verdict{font-size:14px;font-weight:600}
.small,.note{font-size:12px}.note,.fact{fill:#5b6773}.fact{font-size:13px}.axis-title{font-size:13px;font-weight:600}
.paper{fill:#fff}path{fill:none}
.good{fill:#1a7f37}.bad{fill:#c62828}.open{fill:#5b6773}
.curve{stroke-width:2.6;stroke-linejoin:round;stroke-linecap:round}.graph{stroke-width:1.9;stroke-linejoin:round}
.envelope{stroke-width:1;stroke-opacity:.75;stroke-linejoin:round}.teeth{stroke:#8a96a3;stroke-width:.7}
.up{stroke:#1b6ec2}.down{stroke:#cf5a12}.even{stroke:#3f8a3a}.plain{stroke:#1c2733}
.dot{stroke:#1c2733;stroke-linecap:round}.hole{stroke:#fff;stroke-linecap:round}
.vertex{fill:#a3209b;stroke:#fff;stroke-width:1}.inflection{fill:#e0b400;stroke:#1c2733;stroke-width:1}
.arrow{fill:#5b6773}.bar{stroke:#1c2733;stroke-width:1.4}
.grid{stroke:#e1e6eb;stroke-width:1}.faint{stroke:#eff2f5;stroke-width:1}.axis{stroke:#7b8794;stroke-width:1}
.joint{stroke:#1c2733;stroke-width:1}.break{stroke:#0b7a75;stroke-width:1.2;stroke-dasharray:5 4}
.corner{fill:#0b7a75;fill-opacity:.3;stroke:#0b7a75;stroke-width:1.6}.move{stroke:#5b6773;stroke-width:1}.limit{stroke:#c62828;stroke-width:1;stroke-dasharray:2 3}
.region{fill:#ffb300;fill-opacity:.42;stroke:#b07900;stroke-opacity:.85;stroke-width:.6}.fine .curve{stroke-width:1.7}
@media (prefers-color-scheme:dark){
text{fill:#e6eaee}.note,.fact,.open{fill:#9aa6b2}.paper{fill:#14191f}
.good{fill:#57d27a}.bad{fill:#ff7b72}.teeth{stroke:#5d6874}
.up{stroke:#6cb2ff}.down{stroke:#ff9d57}.even{stroke:#8fd07a}.plain{stroke:#e6eaee}
.dot{stroke:#e6eaee}.hole{stroke:#14191f}.vertex{fill:#f08be8;stroke:#14191f}
.inflection{fill:#ffd84a;stroke:#14191f}.arrow{fill:#9aa6b2}.bar{stroke:#e6eaee}
.grid{stroke:#29323b}.faint{stroke:#1e252c}.axis{stroke:#6b7783}.joint{stroke:#e6eaee}
.break{stroke:#45c8c0}.corner{fill:#45c8c0;stroke:#45c8c0}.move{stroke:#9aa6b2}.limit{stroke:#ff7b72}
.region{fill:#ffca4a;fill-opacity:.34;stroke:#ffd97a}}
</style>
)";

}  // namespace

std::string picture_sheet(const std::string& title, const std::string& description,
                          const std::string& body, double height) {
  PictureCanvas picture;
  picture.add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" {6}=\"{7}\">\n<title>{2}</title>\n<desc>{3}</desc>\n{4}"
      "<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n{5}</svg>\n",
      px(kPictureWidth), px(height), escaped_xml(title), escaped_xml(description), kStyle, body,
      kPictureAttribute, kPictureValue);
  return picture.take();
}

}  // namespace obvid

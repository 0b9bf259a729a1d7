// SPDX-License-Identifier: Apache-2.0
#include "plane/sheet.h"

#include "obvid/core/internal/picture_mark.h"
#include "obvid/core/internal/shown_text.h"
#include "obvid/picture/internal/styles.h"
#include "plane/canvas.h"
#include "plane/panels.h"

namespace obvid {
std::string picture_sheet(const std::string& title, const std::string& description,
                          const std::string& body, double height) {
  PictureCanvas picture;
  picture.add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" {6}=\"{7}\">\n<title>{2}</title>\n<desc>{3}</desc>\n{4}"
      "<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n{5}</svg>\n",
      px(kPictureWidth), px(height), escaped_xml(title), escaped_xml(description),
      picture::style_element(picture::plane_sheet_style()), body, kPictureAttribute, kPictureValue);
  return picture.take();
}

}  // namespace obvid

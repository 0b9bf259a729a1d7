/* SPDX-License-Identifier: Apache-2.0 */
/* Knows the C interface alone: find_package(obvid COMPONENTS c). */
#include <stdio.h>

#include "obvid/obvid.h"

int main(void) {
  const double xy[] = {0, 0, 4, 0.4, 8, 1.6, 12, 3.9};
  obvid_input* input = NULL;
  obvid_contour* contour = NULL;
  if (obvid_points(xy, 4, &input, NULL) != 0) return 1;
  if (obvid_fit(input, NULL, NULL, &contour, NULL, NULL) != 0) return 2;
  printf("obvid %s, %zu pieces\n", obvid_version(), obvid_contour_pieces(contour));
  obvid_contour_free(contour);
  obvid_input_free(input);
  return 0;
}

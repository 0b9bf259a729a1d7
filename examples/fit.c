/* SPDX-License-Identifier: Apache-2.0 */
/* Forms a contour through points, proves it, writes it and measures it: the C interface. */
#include <obvid/obvid.h>
#include <stdio.h>

static int told(obvid_error* error) {
  fprintf(stderr, "E%d: %s (%s); %s\n", error->code, error->message, error->where, error->advice);
  const int category = (int)error->category;
  obvid_error_free(error);
  return category;
}

static void progress(void* user, const char* stage, double done) {
  (void)user;
  fprintf(stderr, "\r%3.0f %% %-50s", 100.0 * done, stage);
}

int main(void) {
  const double xy[] = {0, 0, 10, 1, 19, 4, 27, 9, 33, 16, 36, 24};
  const obvid_run run = {NULL, progress, NULL, 0};
  obvid_error* error = NULL;
  obvid_input* input = NULL;
  obvid_contour* contour = NULL;
  obvid_files* files = NULL;
  char* report = NULL;
  if (obvid_points(xy, 6, &input, &error)) return told(error);
  if (obvid_fit(input, "{\"tolerance\": 0.001}", &run, &contour, &report, &error)) {
    return told(error);
  }
  printf("%s", report); /* JSON, as `obvid fit --json` prints it */
  const double middle = 0.5 * obvid_contour_length(contour);
  double point[2], heading, curvature;
  if (obvid_evaluate(contour, OBVID_BY_LENGTH, &middle, 1, point, &heading, &curvature, &error)) {
    return told(error);
  }
  printf("middle %.3f %.3f, radius %.3f\n", point[0], point[1], 1.0 / curvature);
  if (obvid_export(contour, "dxf", NULL, NULL, &files, &error)) return told(error);
  size_t size = 0;
  if (obvid_files_data(files, 0, &size) != NULL) printf("%zu bytes of DXF\n", size);
  obvid_files_free(files);
  obvid_free(report);
  obvid_contour_free(contour);
  obvid_input_free(input);
  return 0;
}

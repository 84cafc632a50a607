/* A simulation by Heun's method, by hand: the states move on by n steps, over which the input runs from u0 to u1. */
#include "vehicle.h"

void forward_steps(const Vehicle *p, const Net *nets, int n, double h, double *x, const double *u0, const double *u1) {
  Transposed transposed[2];
  transpose(nets, transposed);
  double middle[STATES], k1[STATES], k2[STATES];
  Stage stage;
  for (int i = 0; i < n; i++) {
    field(p, nets, transposed, x, u0[i], k1, &stage);
    for (int j = 0; j < STATES; j++) middle[j] = x[j] + h * k1[j];
    field(p, nets, transposed, middle, u1[i], k2, &stage);
    for (int j = 0; j < STATES; j++) x[j] += 0.5 * h * (k1[j] + k2[j]);
  }
}

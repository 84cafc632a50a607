/* Heun's method and its discrete adjoint, by hand. The backward sweep repeats every step from its stored state. */
#include "vehicle.h"
#include <stdlib.h>
#include <string.h>

/* From the adjoint of the force to that of the network's input; adds to the gradient by weights. */
static double backward(const Net *net, const Activations *a, double scale, double force, double to_force, Net *gradient) {
  double to_y = force * to_force, to_z[WIDTH], to_h1[WIDTH] = {0}, to_x = 0;
  gradient->b3 += to_y;
  for (int i = 0; i < WIDTH; i++) {
    gradient->w3[i] += to_y * a->h2[i];
    to_z[i] = a->h2[i] > 0 ? to_y * net->w3[i] : 0;
    gradient->b2[i] += to_z[i];
  }
  for (int i = 0; i < WIDTH; i++)
    for (int j = 0; j < WIDTH; j++) {
      gradient->w2[i][j] += to_z[i] * a->h1[j];
      to_h1[j] += to_z[i] * net->w2[i][j];
    }
  for (int j = 0; j < WIDTH; j++) {
    double to_z1 = a->h1[j] > 0 ? to_h1[j] : 0;
    gradient->b1[j] += to_z1;
    gradient->w1[j] += to_z1 * a->x;
    to_x += to_z1 * net->w1[j];
  }
  return to_x / scale;
}

/* Adds the adjoint of dx, pulled back, to that of x. */
static void field_adjoint(const Vehicle *p, const Net *nets, const Stage *s, const double *to_dx, double *to_x, Net *gradient) {
  double to_tyre = to_dx[3] / p->wheel, to_f = to_dx[1] / p->body - to_tyre;
  double to_travel = to_f * p->c + backward(&nets[0], &s->spring, p->travel, p->force, to_f, &gradient[0]);
  double to_speed = to_f * p->d + backward(&nets[1], &s->damper, p->speed, p->force, to_f, &gradient[1]);
  to_x[0] -= to_travel;
  to_x[1] += to_dx[0] - to_speed;
  to_x[2] += to_travel - p->tyre_c * to_tyre;
  to_x[3] += to_dx[2] + to_speed - p->tyre_d * to_tyre;
  to_x[4] += p->tyre_c * to_tyre;
}

/* The mean over `count` sequences of the normalised error of both accelerations, and its gradient by weights.

   x0: (count, STATES). u0, u1: the input at both ends of each step, (count, n). y: (count, n, OUTPUTS). */
double gradient(const Vehicle *p, const Net *nets, int count, int n, double h, const double *x0, const double *u0,
                const double *u1, const double *y, const double *sigma, Net *result) {
  Transposed transposed[2];
  transpose(nets, transposed);
  double *states = malloc(sizeof(double) * n * STATES), *errors = malloc(sizeof(double) * n * OUTPUTS), total = 0;
  memset(result, 0, 2 * sizeof(Net));
  for (int b = 0; b < count; b++, x0 += STATES, u0 += n, u1 += n, y += n * OUTPUTS) {
    double x[STATES], middle[STATES], k1[STATES], k2[STATES], squares = 0;
    Stage first, second;
    memcpy(x, x0, sizeof x);
    for (int i = 0; i < n; i++) {
      memcpy(states + i * STATES, x, sizeof x);
      field(p, nets, transposed, x, u0[i], k1, &first);
      for (int j = 0; j < OUTPUTS; j++) {
        double e = (k1[1 + 2 * j] - y[OUTPUTS * i + j]) / sigma[j];
        errors[OUTPUTS * i + j] = e;
        squares += e * e;
      }
      for (int j = 0; j < STATES; j++) middle[j] = x[j] + h * k1[j];
      field(p, nets, transposed, middle, u1[i], k2, &second);
      for (int j = 0; j < STATES; j++) x[j] += 0.5 * h * (k1[j] + k2[j]);
    }
    double loss = sqrt(squares / n), weight = 1 / (loss * n * count), adjoint[STATES] = {0};
    total += loss / count;
    for (int i = n - 1; i >= 0; i--) {
      const double *at = states + i * STATES;
      double to_k1[STATES], to_k2[STATES], to_middle[STATES] = {0};
      field(p, nets, transposed, at, u0[i], k1, &first);
      for (int j = 0; j < STATES; j++) middle[j] = at[j] + h * k1[j];
      field(p, nets, transposed, middle, u1[i], k2, &second);
      for (int j = 0; j < STATES; j++) to_k2[j] = 0.5 * h * adjoint[j];
      field_adjoint(p, nets, &second, to_k2, to_middle, result);
      for (int j = 0; j < STATES; j++) {
        to_k1[j] = 0.5 * h * adjoint[j] + h * to_middle[j];
        adjoint[j] += to_middle[j];
      }
      for (int j = 0; j < OUTPUTS; j++) to_k1[1 + 2 * j] += weight * errors[OUTPUTS * i + j] / sigma[j];
      field_adjoint(p, nets, &first, to_k1, adjoint, result);
    }
  }
  free(states);
  free(errors);
  return total;
}

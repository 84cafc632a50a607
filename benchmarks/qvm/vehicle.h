/* The quarter vehicle with two 1-16-16-1 networks, by hand.

   States: height and speed of the body, of the wheel, height of the road. Weights lie as in the file's structures, which
   Python fills and reads as flat arrays. */
#include <math.h>

enum { WIDTH = 16, STATES = 5, OUTPUTS = 2 };

typedef struct { double w1[WIDTH], b1[WIDTH], w2[WIDTH][WIDTH], b2[WIDTH], w3[WIDTH], b3; } Net;
typedef struct { double w2[WIDTH][WIDTH]; } Transposed;
typedef struct { double x, h1[WIDTH], h2[WIDTH]; } Activations;
typedef struct { Activations spring, damper; } Stage;
typedef struct { double body, wheel, c, d, tyre_c, tyre_d, travel, speed, force; } Vehicle;

static double forward(const Net *net, const Transposed *transposed, double in, double scale, double force, Activations *a) {
  a->x = in / scale;
  for (int i = 0; i < WIDTH; i++) {
    double z = net->w1[i] * a->x + net->b1[i];
    a->h1[i] = z > 0 ? z : 0;
  }
  double z[WIDTH];
  for (int i = 0; i < WIDTH; i++) z[i] = net->b2[i];
  for (int j = 0; j < WIDTH; j++)
    for (int i = 0; i < WIDTH; i++) z[i] += transposed->w2[j][i] * a->h1[j];
  for (int i = 0; i < WIDTH; i++) a->h2[i] = z[i] > 0 ? z[i] : 0;
  double y = net->b3;
  for (int i = 0; i < WIDTH; i++) y += net->w3[i] * a->h2[i];
  return force * y;
}

static void field(const Vehicle *p, const Net *nets, const Transposed *t, const double *x, double u, double *dx, Stage *s) {
  double travel = x[2] - x[0], speed = x[3] - x[1];
  double f = p->c * travel + p->d * speed + forward(&nets[0], &t[0], travel, p->travel, p->force, &s->spring)
             + forward(&nets[1], &t[1], speed, p->speed, p->force, &s->damper);
  double tyre = p->tyre_c * (x[4] - x[2]) + p->tyre_d * (u - x[3]);
  dx[0] = x[1];
  dx[1] = f / p->body;
  dx[2] = x[3];
  dx[3] = (tyre - f) / p->wheel;
  dx[4] = u;
}

static void transpose(const Net *nets, Transposed *transposed) {
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < WIDTH; i++)
      for (int j = 0; j < WIDTH; j++) transposed[k].w2[j][i] = nets[k].w2[i][j];
}

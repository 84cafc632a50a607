static int all_finite(const real *a, int n) {
    for (int i = 0; i < n; i++)
        if (!isfinite(a[i])) return 0;
    return 1;
}

/* like XLA: what is not a number stays so */
static inline real maximum(real a, real b) { return b > a || b != b ? b : a; }

static inline real minimum(real a, real b) { return b < a || b != b ? b : a; }

static inline int maximum_int(int a, int b) { return a > b ? a : b; }

static inline int minimum_int(int a, int b) { return a < b ? a : b; }

static inline int absolute_int(int a) { return a < 0 ? -a : a; }

static inline real signum(real a) { return a > 0 ? (real)1 : a < 0 ? (real)-1 : a; }

static inline int signum_int(int a) { return (a > 0) - (a < 0); }

static inline int remainder_int(int a, int b) { return b ? a % b : a; }

static inline real square(real a) { return a * a; }

static inline real one_minus_square(real a) { return (1 - a) * (1 + a); }

static inline real logistic(real a) { return 1 / (1 + exp(-a)); }

static inline real inverse_sqrt(real a) { return 1 / sqrt(a); }

static inline real round_even(real a) { return nearbyint(a); }

static inline int within(int i, int highest) { return i < 0 ? 0 : i > highest ? highest : i; }

static void sort_real(real *a, int n) {
    for (int i = 1; i < n; i++) {
        const real next = a[i];
        int j = i;
        for (; j > 0 && (a[j - 1] > next || (a[j - 1] != a[j - 1] && next == next)); j--) a[j] = a[j - 1];
        a[j] = next;
    }
}

static void sort_with(real *a, int *with, int n) {
    for (int i = 1; i < n; i++) {
        const real next = a[i];
        const int its = with[i];
        int j = i;
        for (; j > 0 && (a[j - 1] > next || (a[j - 1] != a[j - 1] && next == next)); j--) {
            a[j] = a[j - 1];
            with[j] = with[j - 1];
        }
        a[j] = next;
        with[j] = its;
    }
}

/* a = left diag(values) right by one-sided Jacobi rotations (Hestenes); a lies in the larger factor. */
static void svd(real *values, real *left, real *right, int rows, int columns) {
    const int wide = columns > rows, k = wide ? rows : columns, n = wide ? columns : rows;
    real *const a = wide ? right : left, *const v = wide ? left : right; /* n x k, k x k */
    const int down = wide ? 1 : k, over = wide ? n : 1; /* from row to row, from column to column */
    const int down_v = wide ? k : 1, over_v = wide ? 1 : k;
    for (int i = 0; i < k; i++)
        for (int j = 0; j < k; j++) v[i * down_v + j * over_v] = i == j;
    for (int sweep = 0, turned = 1; turned && sweep < 60; sweep++) {
        turned = 0;
        for (int p = 0; p < k - 1; p++)
            for (int q = p + 1; q < k; q++) {
                real pp = 0, qq = 0, pq = 0;
                for (int i = 0; i < n; i++) {
                    const real x = a[i * down + p * over], y = a[i * down + q * over];
                    pp += x * x;
                    qq += y * y;
                    pq += x * y;
                }
                if (!(fabs(pq) > R(1e-15) * sqrt(pp * qq))) continue;
                const real z = (qq - pp) / (2 * pq);
                const real t = (z < 0 ? -1 : 1) / (fabs(z) + sqrt(1 + z * z)), c = 1 / sqrt(1 + t * t), s = c * t;
                turned = 1;
                for (int i = 0; i < n; i++) {
                    real *const x = a + i * down + p * over, *const y = a + i * down + q * over;
                    const real old = *x;
                    *x = c * old - s * *y;
                    *y = s * old + c * *y;
                }
                for (int i = 0; i < k; i++) {
                    real *const x = v + i * down_v + p * over_v, *const y = v + i * down_v + q * over_v;
                    const real old = *x;
                    *x = c * old - s * *y;
                    *y = s * old + c * *y;
                }
            }
    }
    for (int j = 0; j < k; j++) {
        real size = 0;
        for (int i = 0; i < n; i++) size += a[i * down + j * over] * a[i * down + j * over];
        values[j] = sqrt(size);
        for (int i = 0; i < n && size > 0; i++) a[i * down + j * over] /= values[j];
    }
    for (int j = 0; j < k; j++) { /* the largest first */
        int best = j;
        for (int l = j + 1; l < k; l++)
            if (values[l] > values[best]) best = l;
        const real value = values[j];
        values[j] = values[best];
        values[best] = value;
        for (int i = 0; i < n && best != j; i++) {
            const real old = a[i * down + j * over];
            a[i * down + j * over] = a[i * down + best * over];
            a[i * down + best * over] = old;
        }
        for (int i = 0; i < k && best != j; i++) {
            const real old = v[i * down_v + j * over_v];
            v[i * down_v + j * over_v] = v[i * down_v + best * over_v];
            v[i * down_v + best * over_v] = old;
        }
    }
}

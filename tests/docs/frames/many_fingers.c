/* Around the lines of docs/batch.md: the caller's own arrays. */
#include <hl/hl_batch.h>
#include <stddef.h>

void useFingers(const double* positions, double* proxies, double* forces, HLint* contacts);

void useFingers(const double* positions, double* proxies, double* forces, HLint* contacts) {
  /* block */
  (void)positions;
}

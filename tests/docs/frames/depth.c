/* Around the lines of docs/depth.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawDepths(void);

void drawDepths(void) {
  /* block */
  hlFlush();
}

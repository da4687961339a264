/* Around the lines of docs/implicit.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawImplicit(void);

void drawImplicit(void) {
  /* block */
  hlFlush();
}

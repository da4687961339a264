/* Around the lines of docs/heights.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawHeights(void);

void drawHeights(void) {
  /* block */
  hlFlush();
}

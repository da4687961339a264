/* Around the lines of docs/patches.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawPatches(void);

void drawPatches(void) {
  /* block */
  hlFlush();
}

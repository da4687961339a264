/* Around the lines of docs/clouds.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawClouds(void);

void drawClouds(void) {
  /* block */
  hlFlush();
}

/* Around the lines of docs/volumes.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawVolumes(void);

void drawVolumes(void) {
  /* block */
  hlFlush();
}

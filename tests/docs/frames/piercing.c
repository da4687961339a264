/* Around the lines of docs/piercing.md. */
#include <hl/hl.h>

#include <stddef.h>

void drawNeedles(void);

void drawNeedles(void) {
  /* block */
  hlFlush();
}

/* Around the lines of docs/stylus.md. */
#include <hl/hl.h>

void useStylus(void);

void useStylus(void) {
  /* block */
  hlPoll();
}

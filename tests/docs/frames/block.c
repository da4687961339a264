/* Around the lines of docs/bodies.md: the caller's own drawing. */
#include <hl/hl.h>

void drawBlock(void);
void drawForTheEye(const double* matrix);
void useBodies(HLuint block);

void useBodies(HLuint block) {
  /* block */
  hlCallObject(block);
}

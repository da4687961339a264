/* hl.h is C99: this file is compiled as such and uses each kind of thing that the header declares. */
#include <hl/hl.h>
#include <stddef.h>

static void heard(const HLevent* event, void* user) { *(HLenum*)user = event->kind; }
static void failed(HLenum error, const char* text, void* user) {
  (void)text;
  *(HLenum*)user = error;
}

/* Without a context every call is harmless; returns 0 when all went as it should. */
int useFromC(void) {
  HLenum seen = HL_NONE;
  HLdouble position[3] = {1, 2, 3};
  HLcontact contact;
  const HLfloat vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  hlErrorFunc(failed, &seen);
  hlEventFunc(HL_EVENT_TOUCH, heard, &seen);
  hlBegin(HL_TRIANGLES);
  hlVertex3fv(vertices);
  hlEnd();
  hlVertexPointer(3, HL_FLOAT, 0, vertices);
  hlDrawArrays(HL_TRIANGLES, 0, 3);
  hlGetDoublev(HL_FINGER_POSITION, position);
  hlPushAttrib(HL_SURFACE_BIT | HL_CURRENT_BIT);
  if (hlGetContacts(1, &contact) != 0) return 1;
  if (hlGetCurrentContext() != NULL) return 2;
  if (hlGetError() != HL_NO_CONTEXT) return 3;
  return seen == HL_NONE && position[0] == 1 ? 0 : 4;
}

// One function draws for the eye and for the hand: it calls through a table that holds GL's or HL's calls, which have
// the same names, meanings and types. A GLFW window shows the scene and the proxy.
//
//   09_gl_and_touch [URL [SECONDS]]
//
// While a mouse button is down, the mouse moves the hand of a simulated device.
#include <GL/gl.h>
#include <GLFW/glfw3.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hl/hl.hpp>
#include <stdexcept>
#include <string>

namespace {

struct Calls {
  decltype(&glBegin) begin;
  decltype(&glEnd) end;
  decltype(&glNormal3d) normal;
  decltype(&glVertex3d) vertex;
  decltype(&glPushMatrix) push;
  decltype(&glPopMatrix) pop;
  decltype(&glTranslated) translate;
  decltype(&glRotated) rotate;
  decltype(&glCallList) call;
};
constexpr Calls kSee{glBegin,     glEnd,        glNormal3d, glVertex3d, glPushMatrix,
                     glPopMatrix, glTranslated, glRotated,  glCallList};
constexpr Calls kFeel{hlBegin,     hlEnd,        hlNormal3d, hlVertex3d,  hlPushMatrix,
                      hlPopMatrix, hlTranslated, hlRotated,  hlCallObject};
constexpr GLuint kBall = 1;
constexpr double kRadius = 0.014;  // m

void drawSphere(const Calls& to, double radius) {
  for (int i = 0; i < 12; ++i) {
    to.begin(GL_QUAD_STRIP);  // HL_QUAD_STRIP is the same number
    for (int j = 0; j <= 24; ++j) {
      for (const int side : {1, 0}) {
        const double theta = M_PI * (i + side) / 12, phi = 2 * M_PI * j / 24;
        const double x = std::sin(theta) * std::sin(phi), y = std::cos(theta), z = std::sin(theta) * std::cos(phi);
        to.normal(x, y, z);
        to.vertex(radius * x, radius * y, radius * z);
      }
    }
    to.end();
  }
}

// What is a display list for GL is an object for HL: sent once, and carried along smoothly when it moves.
void defineBall() {
  glNewList(kBall, GL_COMPILE);
  drawSphere(kSee, kRadius);
  glEndList();
  hlNewObject(kBall);
  drawSphere(kFeel, kRadius);
  hlEndObject();
}

// A turning ring of eight balls.
void drawScene(const Calls& to, double t) {
  for (int i = 0; i < 8; ++i) {
    to.push();
    to.rotate(45 * i + 20 * t, 0, 1, 0);
    to.translate(0.04, 0, 0);
    to.call(kBall);
    to.pop();
  }
}

// Looks down at the scene from 60 degrees; a square of 0.16 m is seen.
void look(GLFWwindow* window, const std::array<double, 3>& proxy, double t) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  glViewport(0, 0, width, height);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (const GLenum capability : {GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL}) glEnable(capability);
  glLoadIdentity();
  glOrtho(-0.08, 0.08, -0.08, 0.08, -0.2, 0.2);
  glRotated(60, 1, 0, 0);
  glColor3d(0.8, 0.7, 0.5);
  drawScene(kSee, t);
  glTranslated(proxy[0], proxy[1], proxy[2]);
  glColor3d(0.9, 0.2, 0.2);
  drawSphere(kSee, hl::get(HL_PROXY_RADIUS));
  glfwSwapBuffers(window);
}

void moveHand(GLFWwindow* window, const std::string& url, double t) {
  double x = 0, y = 0;
  int width = 1, height = 1;
  glfwGetCursorPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
    hlHandGoal3d(0.16 * x / width - 0.08, 0.005, (0.16 * y / height - 0.08) / std::sin(M_PI / 3));
  } else if (url.starts_with("inproc:")) {
    hlHandGoal3d(0.04 * std::sin(0.3 * t), 0.008, 0.04 * std::cos(0.3 * t));  // nobody there: the hand goes round
  }
}

GLFWwindow* openWindow() {
  GLFWwindow* window = glfwInit() == GLFW_TRUE ? glfwCreateWindow(600, 600, "HL and GL", nullptr, nullptr) : nullptr;
  if (window == nullptr) throw std::runtime_error("there is no screen with OpenGL");
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  return window;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1e9;
  GLFWwindow* window = openWindow();
  hl::Context context(url);
  context.onEvent(HL_EVENT_TOUCH, [](const HLevent& event) { std::printf("touching at %.3f s\n", event.time); });
  hlWorkspaced(0, 0.04, 0, 1);
  defineBall();
  while (glfwWindowShouldClose(window) == GLFW_FALSE && glfwGetTime() < seconds) {
    const double t = glfwGetTime();
    drawScene(kFeel, t);
    hlFlush();
    context.poll();
    look(window, hl::get<3>(HL_PROXY_POSITION), t);
    moveHand(window, url, t);
    glfwPollEvents();
  }
  hl::check();
  glfwTerminate();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "09_gl_and_touch: %s\n", error.what());
  return 2;
}

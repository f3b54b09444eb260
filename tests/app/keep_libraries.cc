// Preloaded by leak tests so that libraries stay loaded. OpenGL's driver is unloaded with the last
// window or context. The only pointers to its per-process memory disappear with it. The leak
// checker would report that memory as lost and could not name its owner.
extern "C" int dlclose(void* /*library*/) { return 0; }

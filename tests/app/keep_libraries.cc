// Loaded before the C library's where leaks are looked for: libraries stay where they are. OpenGL's
// driver is unloaded with the last window or context, and with it go the only pointers to what it
// keeps once a process: the leak checker would call that lost, and could not say whose it was.
extern "C" int dlclose(void* /*library*/) { return 0; }

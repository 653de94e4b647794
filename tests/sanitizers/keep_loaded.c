/* Keeps every library in memory until the process ends. LeakSanitizer looks for leaks at exit; what
 * a driver or a runtime allocated and the process can still reach only through that library's own
 * data would look lost once the library is gone, and with no name that lsan.supp could match.
 * ./dev test --sanitize address builds and preloads this. */
int dlclose(void *library) {
    (void)library;
    return 0;
}

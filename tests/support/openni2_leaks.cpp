// What OpenNI2 and its stock drivers never free is not ours to mend. Part of every program that
// uses OpenNI2, in the sanitized builds alone.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_options();

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOpenNI2\nleak:libPS1080\nleak:libPSLink\nleak:libOniFile\nleak:libfreenect\n";
}

extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }

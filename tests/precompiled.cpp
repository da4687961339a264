// Empty: what hl_test() compiles once for the tests' common headers hangs on this file.

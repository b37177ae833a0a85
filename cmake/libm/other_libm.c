// A C library whose sine, logarithm and the like differ in the last bit, as those of two systems do. Preloaded, it answers calls of the
// program itself with the double next above the true answer, and leaves those of libraries alone (PROJ, OpenColorIO and Embree have bits of
// their own). tools/test_hard libm renders with it: a pixel that moves hangs on a function that base/math_exact.h has as well.
// With OTHER_LIBM_CALLS=FILE the names of the functions that were called are appended to FILE at the end.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <link.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static unsigned long text_from, text_to;

static int first_object(struct dl_phdr_info* object, size_t size, void* unused) {
  (void)size;
  (void)unused;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)* part = &object->dlpi_phdr[i];
    if (part->p_type != PT_LOAD || !(part->p_flags & PF_X)) continue;
    text_from = object->dlpi_addr + part->p_vaddr;
    text_to = text_from + part->p_memsz;
  }
  return 1;  // the program comes first, and is all that is asked for
}

__attribute__((constructor)) static void find_program(void) { dl_iterate_phdr(first_object, NULL); }

static int from_program(const void* caller) {
  const unsigned long at = (unsigned long)caller;
  return at >= text_from && at < text_to;
}

#define FUNCTIONS(one, two)                                                                                                     \
  one(sin) one(cos) one(tan) one(asin) one(acos) one(atan) one(sinh) one(cosh) one(tanh) one(exp) one(exp2) one(expm1) one(log) \
      one(log2) one(log10) one(log1p) one(cbrt) one(erf) one(tgamma) two(atan2) two(pow) two(hypot)

#define COUNT(name) static int name##_called, name##f_called;
FUNCTIONS(COUNT, COUNT)

#define ONE(name)                                                                             \
  double name(double x) {                                                                     \
    static double (*real)(double);                                                            \
    if (!real) real = (double (*)(double))dlsym(RTLD_NEXT, #name);                            \
    if (!from_program(__builtin_return_address(0))) return real(x);                           \
    name##_called = 1;                                                                        \
    return nextafter(real(x), INFINITY);                                                      \
  }                                                                                           \
  float name##f(float x) {                                                                    \
    static float (*real)(float);                                                              \
    if (!real) real = (float (*)(float))dlsym(RTLD_NEXT, #name "f");                          \
    if (!from_program(__builtin_return_address(0))) return real(x);                           \
    name##f_called = 1;                                                                       \
    return nextafterf(real(x), INFINITY);                                                     \
  }
#define TWO(name)                                                                             \
  double name(double x, double y) {                                                           \
    static double (*real)(double, double);                                                    \
    if (!real) real = (double (*)(double, double))dlsym(RTLD_NEXT, #name);                    \
    if (!from_program(__builtin_return_address(0))) return real(x, y);                        \
    name##_called = 1;                                                                        \
    return nextafter(real(x, y), INFINITY);                                                   \
  }                                                                                           \
  float name##f(float x, float y) {                                                           \
    static float (*real)(float, float);                                                       \
    if (!real) real = (float (*)(float, float))dlsym(RTLD_NEXT, #name "f");                   \
    if (!from_program(__builtin_return_address(0))) return real(x, y);                        \
    name##f_called = 1;                                                                       \
    return nextafterf(real(x, y), INFINITY);                                                  \
  }
FUNCTIONS(ONE, TWO)

// gcc joins a sine and a cosine of one angle.
void sincos(double x, double* sine, double* cosine) {
  static void (*real)(double, double*, double*);
  if (!real) real = (void (*)(double, double*, double*))dlsym(RTLD_NEXT, "sincos");
  real(x, sine, cosine);
  if (!from_program(__builtin_return_address(0))) return;
  sin_called = cos_called = 1;
  *sine = nextafter(*sine, INFINITY);
  *cosine = nextafter(*cosine, INFINITY);
}
void sincosf(float x, float* sine, float* cosine) {
  static void (*real)(float, float*, float*);
  if (!real) real = (void (*)(float, float*, float*))dlsym(RTLD_NEXT, "sincosf");
  real(x, sine, cosine);
  if (!from_program(__builtin_return_address(0))) return;
  sinf_called = cosf_called = 1;
  *sine = nextafterf(*sine, INFINITY);
  *cosine = nextafterf(*cosine, INFINITY);
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("OTHER_LIBM_CALLS");
  FILE* file = path ? fopen(path, "a") : NULL;
  if (!file) return;
#define TELL(name)                               \
  if (name##_called) fprintf(file, #name "\n");  \
  if (name##f_called) fprintf(file, #name "f\n");
  FUNCTIONS(TELL, TELL)
  fclose(file);
}

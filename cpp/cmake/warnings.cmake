# saltus_warnings(target): our own code is compiled with these; imported headers (Eigen, GoogleTest) are -isystem.
#
# Left out on purpose: -Wsign-conversion (Eigen::Index is signed, std::size_t is not, and every container index
# would need a cast that hides more than it shows).
function(saltus_warnings target)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 $<$<BOOL:${SALTUS_WERROR}>:/WX>)
    return()
  endif()
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion -Wold-style-cast
    -Wcast-qual -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi -Wundef)
  if(SALTUS_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC guesses these from optimised code, and guesses wrong inside Eigen's expressions.
      target_compile_options(${target} PRIVATE
        -Wno-error=maybe-uninitialized -Wno-error=array-bounds -Wno-error=stringop-overflow
        -Wno-error=stringop-overread -Wno-error=null-dereference)
    endif()
  endif()
endfunction()

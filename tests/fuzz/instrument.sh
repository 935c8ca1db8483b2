#!/bin/sh
# Stands between cargo and the compiler of this workspace's crates: counters for libFuzzer, which stable Rust has as a pass
# of LLVM, and the checks of a debug build. What they depend on is compiled as ever, and once for the program and for this.
case " $* " in
*" --crate-name midplane "* | *" --crate-name fuzz_"*)
    exec "$@" -Cpasses=sancov-module \
        -Cllvm-args=-sanitizer-coverage-level=4 \
        -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
        -Cllvm-args=-sanitizer-coverage-pc-table \
        -Cllvm-args=-sanitizer-coverage-trace-compares \
        -Cdebug-assertions=on -Coverflow-checks=on --cfg fuzzing
    ;;
esac
exec "$@"

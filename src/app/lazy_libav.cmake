# Writes an assembler file that stands in for FFmpeg's libraries: cmake -DARCHIVE=… -DNM=… -DOUT=… -P lazy_libav.cmake
#
# FFmpeg's libraries bring 130 others with them, and loading these takes longer than comparing two 1080p pictures. So the
# program is not linked to them. Each of their functions that the library uses gets a jump through a slot here; the first
# call of any of them loads the libraries and fills all slots (lazy_libav.cpp).
execute_process(COMMAND ${NM} -u ${ARCHIVE} OUTPUT_VARIABLE undefined COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "U (av|avcodec|avformat|avio|avutil|sws|swscale|swr)_[A-Za-z0-9_]+" lines "${undefined}")
list(TRANSFORM lines REPLACE "^U " "")
list(REMOVE_DUPLICATES lines)
list(SORT lines)

set(text "# Made by src/app/lazy_libav.cmake: the functions of FFmpeg's libraries, loaded at their first call.\n\t.text\n")
set(slots "")
set(names "")
set(strings "")
set(index 0)
foreach(name IN LISTS lines)
  string(APPEND text "\t.globl ${name}\n\t.type ${name}, @function\n${name}:\n\tjmp *(.Lslots+8*${index})(%rip)\n"
         ".Lload${index}:\n\t.cfi_startproc\n\tpushq $${index}\n\t.cfi_adjust_cfa_offset 8\n\tjmp .Lload\n\t.cfi_endproc\n")
  string(APPEND slots "\t.quad .Lload${index}\n")
  string(APPEND names "\t.quad .Lname${index}\n")
  string(APPEND strings ".Lname${index}:\n\t.asciz \"${name}\"\n")
  math(EXPR index "${index} + 1")
endforeach()

# Keeps every register that may hold an argument, calls offstageLoadLibav, and jumps through the slot, now filled.
set(saved "\t.cfi_startproc\n\t.cfi_def_cfa_offset 16\n")
set(restored "")
foreach(register rax rdi rsi rdx rcx r8 r9)
  string(APPEND saved "\tpushq %${register}\n\t.cfi_adjust_cfa_offset 8\n")
  string(PREPEND restored "\tpopq %${register}\n\t.cfi_adjust_cfa_offset -8\n")
endforeach()
string(APPEND saved "\tsubq $136, %rsp\n\t.cfi_adjust_cfa_offset 136\n")
string(PREPEND restored "\taddq $136, %rsp\n\t.cfi_adjust_cfa_offset -136\n")
foreach(number RANGE 7)
  math(EXPR at "16 * ${number}")
  string(APPEND saved "\tmovups %xmm${number}, ${at}(%rsp)\n")
  string(PREPEND restored "\tmovups ${at}(%rsp), %xmm${number}\n")
endforeach()
# With the return address and the index these are nine words; 136 bytes more and the stack is aligned to 16 for the call.
string(APPEND text ".Lload:\n${saved}\tcall offstageLoadLibav@PLT\n${restored}"
       "\tpopq %r11\n\t.cfi_adjust_cfa_offset -8\n\tleaq .Lslots(%rip), %r10\n\tjmp *(%r10,%r11,8)\n\t.cfi_endproc\n")

string(APPEND text "\t.data\n\t.balign 8\n\t.globl offstageLibavSlots\noffstageLibavSlots:\n.Lslots:\n${slots}"
       "\t.section .data.rel.ro, \"aw\"\n\t.balign 8\n\t.globl offstageLibavNames\noffstageLibavNames:\n${names}\t.quad 0\n"
       "\t.section .rodata\n${strings}\t.section .note.GNU-stack, \"\", @progbits\n")
file(WRITE ${OUT} "${text}")

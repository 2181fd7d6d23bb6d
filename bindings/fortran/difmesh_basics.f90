! Statuses, messages and the preparation of structs.
module difmesh_basics
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int32_t, c_int64_t, &
    c_intptr_t, c_null_char, c_ptr, c_sizeof
  use difmesh_types
  use difmesh_c
  implicit none
  private

  public :: dif_init, dif_message, dif_name_of_status, dif_library_version
  ! For the other modules of this library.
  public :: finish, refuse, no_room, to_c, from_c, get_list, address_of

  ! Prepares a struct, with the defaults of the library where it holds options. A library of another
  ! interface may refuse; struct_size then stays 0, and calls with the struct say so.
  interface dif_init
    module procedure init_options, init_report, init_function_options, init_function_report, &
      init_triangle_options, init_triangle_report, init_shape_options, init_measure, &
      init_distance_options, init_distance, init_mesh_write_options, init_mesh_write_report, &
      init_mesh_read_options, init_raw_layout, init_field_read_options, &
      init_field_write_options, init_block, init_mollify_options, init_curvature_options, &
      init_smoothing_options
  end interface

  integer, parameter :: longest_text = 1024  ! of any message

contains

  ! What went wrong in the last call of the library that failed on this thread; '' if none did.
  function dif_message() result(text)
    character(:), allocatable :: text
    text = from_c(dif_last_message())
  end function

  ! 'DIF_OK' and so on.
  function dif_name_of_status(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(:), allocatable :: text
    text = from_c(dif_status_name(status))
  end function

  function dif_library_version() result(text)
    character(:), allocatable :: text
    text = from_c(dif_version_text())
  end function

  function from_c(text) result(copy)
    type(c_ptr), intent(in) :: text
    character(:), allocatable :: copy
    allocate (character(length_of(text)) :: copy)
    call get_text(text, copy)
  end function

  integer function length_of(text)
    type(c_ptr), intent(in) :: text
    character(kind=c_char), pointer :: letters(:)
    call c_f_pointer(text, letters, [longest_text])
    do length_of = 0, longest_text - 1
      if (letters(length_of + 1) == c_null_char) return
    end do
  end function

  ! Padded with blanks, or cut off.
  subroutine get_text(text, copy)
    type(c_ptr), intent(in) :: text
    character(*), intent(inout) :: copy
    character(kind=c_char), pointer :: letters(:)
    integer :: n
    copy = ''
    call c_f_pointer(text, letters, [longest_text])
    do n = 1, min(len(copy), length_of(text))
      copy(n:n) = letters(n)
    end do
  end subroutine

  ! The texts that a function of the library gives for a handle and the numbers from 0 on, padded with
  ! blanks, or cut off.
  subroutine get_list(handle, text_of, list, status, message)
    type(c_ptr), intent(in) :: handle
    procedure(dif_mesh_warning) :: text_of
    character(*), allocatable, intent(out) :: list(:)
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    type(c_ptr) :: text
    integer(c_int64_t) :: count, n
    integer :: code
    count = 0
    do
      call finish(text_of(handle, count, text), status, message)
      if (status /= dif_ok) return
      if (.not. c_associated(text)) exit
      count = count + 1
    end do
    allocate (list(count), stat=code)
    if (no_room(code, status, message)) return
    do n = 1, count
      status = text_of(handle, n - 1, text)
      call get_text(text, list(n))
    end do
  end subroutine

  ! Paths and names, without the blanks that pad them, as in an open statement.
  pure function to_c(path) result(text)
    character(*), intent(in) :: path
    character(kind=c_char) :: text(len_trim(path) + 1)
    integer :: n
    do n = 1, size(text) - 1
      text(n) = path(n:n)
    end do
    text(size(text)) = c_null_char
  end function

  ! As iomsg and errmsg in Fortran's own statements, message changes on an error only.
  subroutine finish(code, status, message)
    integer(c_int32_t), intent(in) :: code
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    status = code
    if (code /= dif_ok .and. present(message)) call get_text(dif_last_message(), message)
  end subroutine

  ! Of arguments that cannot be handed to the library.
  subroutine refuse(reason, status, message)
    character(*), intent(in) :: reason
    integer(c_int32_t), intent(out) :: status
    character(*), intent(inout), optional :: message
    status = dif_error_invalid_argument
    if (present(message)) message = reason
  end subroutine

  ! Whether an allocate statement with this stat failed.
  logical function no_room(code, status, message)
    integer, intent(in) :: code
    integer(c_int32_t), intent(inout) :: status
    character(*), intent(inout), optional :: message
    no_room = code /= 0
    if (.not. no_room) return
    status = dif_error_out_of_memory
    if (present(message)) message = 'out of memory'
  end function

  integer(c_int64_t) function address_of(pointer)
    type(c_ptr), intent(in) :: pointer
    address_of = int(transfer(pointer, 0_c_intptr_t), c_int64_t)
  end function

  subroutine init_options(struct)
    type(dif_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_report(struct)
    type(dif_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_function_options(struct)
    type(dif_function_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_function_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_function_report(struct)
    type(dif_function_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_function_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_triangle_options(struct)
    type(dif_triangle_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_triangle_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_triangle_report(struct)
    type(dif_triangle_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_triangle_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_shape_options(struct)
    type(dif_shape_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_shape_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_measure(struct)
    type(dif_measure), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_measure_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_distance_options(struct)
    type(dif_distance_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_distance_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_distance(struct)
    type(dif_distance), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_distance_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mesh_write_options(struct)
    type(dif_mesh_write_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mesh_write_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mesh_write_report(struct)
    type(dif_mesh_write_report), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mesh_write_report_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mesh_read_options(struct)
    type(dif_mesh_read_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mesh_read_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_raw_layout(struct)
    type(dif_raw_layout), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_raw_layout_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_field_read_options(struct)
    type(dif_field_read_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_field_read_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_field_write_options(struct)
    type(dif_field_write_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_field_write_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_block(struct)
    type(dif_block), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_block_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_mollify_options(struct)
    type(dif_mollify_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_mollify_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_curvature_options(struct)
    type(dif_curvature_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_curvature_options_init(struct, c_sizeof(struct))
  end subroutine

  subroutine init_smoothing_options(struct)
    type(dif_smoothing_options), intent(out) :: struct
    integer(c_int32_t) :: ignored
    ignored = dif_smoothing_options_init(struct, c_sizeof(struct))
  end subroutine

end module

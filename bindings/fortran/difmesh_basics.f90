! Statuses, messages and what the other modules share.
module difmesh_basics
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int32_t, c_int64_t, &
    c_intptr_t, c_null_char, c_ptr
  use difmesh_types
  use difmesh_c
  use difmesh_init
  implicit none
  private

  public :: dif_init, dif_message, dif_name_of_status, dif_library_version
  ! For the other modules of this library.
  public :: finish, refuse, no_room, to_c, from_c, get_list, address_of

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

  ! The texts that a function of the library gives for a handle and the numbers from 0 on, padded
  ! with blanks, or cut off.
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

end module
